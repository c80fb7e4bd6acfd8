#pragma once
/// Conversions between the program's internal units and the units of the input.
///
/// The internal units are the length r (radius), the mass ρr³ (ρ: density) and a time t. For an elastic ball without
/// self-gravity, t is r/c with the speed of shear waves c = √(μ/ρ). In the output, a quantity of dimension length^a
/// mass^b time^d is multiplied by r^a (ρr³)^b t^d, for example:
///   energy  mass·length²/time²     J, Z  mass·length²/time     Q̇  1/time     λ per m̄  1/time²     a_i  length

#include "entries/unit.h"

namespace pseudorigid::io {

struct Units {
  double length = 1, mass = 1, time = 1;

  double velocity() const { return length / time; }
  double energy() const { return mass * velocity() * velocity(); }
  double momentum() const { return mass * length * velocity(); }  ///< the unit of J and Z
  double stress() const { return energy() / (length * length * length); }
  double multiplier() const { return 1 / (time * time); }

  /// Converts a quantity with the given unit from internal units to the units of the input.
  double to_physical(double internal, scene::Unit unit) const;
  /// Converts a quantity with the given unit from the units of the input to internal units.
  double to_internal(double physical, scene::Unit unit) const;
};

/// The units of a ball with radius r and density ρ, both positive, and with the given unit of time (scene/scales.h).
Units ball_units(double radius, double density, double time);

}  // namespace pseudorigid::io
