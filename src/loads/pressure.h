#pragma once
/// A follower pressure: the traction −p n per current area with the current normal n, and the energy p V with the
/// current volume V. In a body of constant volume the constraint balances the pressure, and the motion does not change.
/// The program therefore omits the load. The true pressure inside the body is larger than the computed pressure by p
/// everywhere. The column `multiplier` contains the multiplier of the constraint divided by m̄ = tr E₀/3, with E₀ = ∫ρ X
/// Xᵀ dX (observables/body_observables.h). With the load, this quotient would be larger by the constant p V/m̄, which
/// the log contains.

#include <cstdio>

#include "loads/load.h"

namespace pseudorigid::loads {

struct Pressure {
  double pressure = 0;  ///< the pressure p of the surroundings

  template <class Self, class Visit>
  static void visit_entries(Self& self, Visit& visit) {
    visit(
        self.pressure, scene::Number{},
        scene::About{"Loads/Pressure", "pressure",
                     "Pressure p of the surroundings: the traction -p n per current area with the current normal n of "
                     "the surface. Its energy is p (current volume). It does not move a body that keeps its volume. "
                     "The multiplier and the pressure inside are then higher by a constant, which the log has and "
                     "their columns do not contain."});
  }

  static constexpr std::string_view no_equilibria = "";
  static constexpr std::string_view skipped = "follower pressure: Loads/Pressure is 0";
  std::string needed(const BodyFacts& body) const {
    if (!body.incompressible) return "follower pressure on the surface";
    char higher[96];
    std::snprintf(higher, sizeof higher, "pressure inside is %.9g and the multiplier %.9g higher", pressure,
                  pressure * body.volume_by_inertia);
    return std::string(
               "follower pressure, as a constant: the body keeps its volume, so there is no force; beyond their "
               "columns the ") +
           higher;
  }

  Forcing forcing() const { return {.pressure = pressure}; }
};

}  // namespace pseudorigid::loads
