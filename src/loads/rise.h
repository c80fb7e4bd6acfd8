#pragma once
/// The tidal matrix, the periodic tide, the acceleration, the traction and the pressure rise from 0 to their full
/// strength until the time T. Other loads do not rise. The factor is
///
///   s(t) = x³ (10 − 15x + 6x²) with x = t/T until T,   s(t) = 1 from then on.
///
/// The factor has two continuous derivatives. A traction that acts at once sends a shear front from the surface to the
/// centre. A traction that rises during several periods of the slowest mode does not.

#include <algorithm>

#include "loads/load.h"

namespace pseudorigid::loads {

struct Rise {
  double time = 0;  ///< the time T; 0: all loads have their full strength from the start

  template <class Self, class Visit>
  static void visit_entries(Self& self, Visit& visit) {
    visit(
        self.time, scene::not_negative,
        scene::About{
            "Loads/Rise time", "time",
            "Tidal matrix, periodic tide, acceleration, traction and pressure rise smoothly from 0 to their full "
            "strength until this time. A traction that acts at once (0) sends a shear front through the body; one that "
            "rises during several periods does not. The column external subtracts the energy that the rise has given "
            "to the body, so that the column energy is constant."});
  }

  static constexpr std::string_view no_equilibria = "equilibria are those under constant loads; set the rise time to 0";
  static constexpr bool has_static_equilibria = false;
  static constexpr std::string_view skipped = "rise of the loads: Loads/Rise time is 0";
  std::string needed(const BodyFacts&) const {
    return "loads that rise smoothly from 0, and the energy that they give";
  }

  Forcing forcing() const { return {}; }
  bool is_present() const { return time > 0; }

  /// factor(t) returns s(t), and factor_rate(t) returns its derivative. Both are 0 before t = 0. T must not be 0.
  double factor(double t) const {
    const double x = part(t);
    return x * x * x * (10 - x * (15 - 6 * x));
  }
  double factor_rate(double t) const {
    const double x = part(t);
    return 30 * x * x * (1 - x) * (1 - x) / time;
  }
  /// Returns the part of the forcing that rises, at full strength.
  static Forcing rising(const Forcing& f) {
    return {.quadratic = f.quadratic,
            .acceleration = f.acceleration,
            .nominal_traction = f.nominal_traction,
            .pressure = f.pressure};
  }
  /// Returns the part of the forcing that does not rise.
  static Forcing constant(Forcing f) {
    f.quadratic.setZero();
    f.acceleration.setZero();
    f.nominal_traction.setZero();
    f.pressure = 0;
    return f;
  }
  /// Returns the loads of `f` that can rise, times a factor. Other members of the result are 0.
  static Forcing times(double factor, const Forcing& f) {
    return {.quadratic = factor * f.quadratic,
            .acceleration = factor * f.acceleration,
            .nominal_traction = factor * f.nominal_traction,
            .pressure = factor * f.pressure};
  }

 private:
  double part(double t) const { return std::clamp(t / time, 0.0, 1.0); }
};

}  // namespace pseudorigid::loads
