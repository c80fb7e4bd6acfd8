#pragma once
/// A periodic tide with the external potential energy ½ xᵀTx cos(ωt + φ) per mass.

#include <cmath>

#include "loads/load.h"

namespace pseudorigid::loads {

struct PeriodicTide {
  scene::Matrix3 amplitude{};       ///< the matrix T
  double frequency = 1, phase = 0;  ///< angular frequency ω and phase φ

  template <class Self, class Visit>
  static void visit_entries(Self& self, Visit& visit) {
    visit(self.amplitude, scene::Matrix{.symmetric = true},
          scene::About{
              "Loads/Tidal amplitude", "1/time^2",
              "Symmetric T of the external potential energy x^T T x/2 cos(w t + p) per mass: a periodic tide. The "
              "column external subtracts the energy that it has given to the body, so that the column energy is "
              "constant."});
    visit(self.frequency, scene::Number{}, scene::About{"Loads/Tidal frequency", "1/time", "w of the periodic tide."});
    visit(self.phase, scene::Number{}, scene::About{"Loads/Tidal phase", "", "p of the periodic tide, in radians."});
  }

  static constexpr std::string_view no_equilibria = "no body is in equilibrium under a periodic tide";
  static constexpr std::string_view skipped = "periodic tide: Loads/Tidal amplitude is 0";
  std::string needed(const BodyFacts&) const { return "periodic tide, and the energy that it gives"; }

  Forcing forcing(double t) const { return times(std::cos(frequency * t + phase)); }
  Forcing forcing_rate(double t) const { return times(-frequency * std::sin(frequency * t + phase)); }
  Forcing largest_forcing() const { return times(1); }
  double angular_frequency() const { return frequency; }

 private:
  Forcing times(double factor) const { return {.quadratic = factor * to_eigen(amplitude)}; }
};

}  // namespace pseudorigid::loads
