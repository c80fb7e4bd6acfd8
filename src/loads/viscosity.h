#pragma once
/// Objective viscosity (Kelvin–Voigt) with the Cauchy stress 2ηd. Here d is the symmetric part of the velocity
/// gradient.

#include "loads/load.h"

namespace pseudorigid::loads {

struct Viscosity {
  double viscosity = 0;  ///< the viscosity η, in pressure · time

  template <class Self, class Visit>
  static void visit_entries(Self& self, Visit& visit) {
    visit(self.viscosity, scene::not_negative,
          scene::About{"Material/Viscosity", "pressure*time",
                       "eta of the objective (Kelvin-Voigt) viscosity: the Cauchy stress 2 eta d, with d the symmetric "
                       "velocity gradient. It does not act on rigid motions and conserves the angular momentum."});
  }

  static constexpr std::string_view no_equilibria = "";
  static constexpr std::string_view skipped = "";
  std::string needed(const BodyFacts&) const { return {}; }

  Forcing forcing() const { return {.viscosity = viscosity}; }
};

}  // namespace pseudorigid::loads
