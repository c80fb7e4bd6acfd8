#pragma once
/// Conversions between the program's internal units and the units of the input.
///
/// The internal units are the length r, the mass ρr³ and a time t, which is r/c with c = √(μ/ρ) for an elastic ball. In
/// the output, a quantity of dimension length^a mass^b time^d is multiplied by r^a (ρr³)^b t^d:
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

  /// Converts a quantity with this unit from internal units.
  double to_physical(double internal, scene::Unit unit) const;
  /// Converts a quantity with this unit to internal units.
  double to_internal(double physical, scene::Unit unit) const;
};

/// The units of a ball with radius r and density ρ, both positive, and with this unit of time (scene/scales.h).
Units ball_units(double radius, double density, double time);

}  // namespace pseudorigid::io
