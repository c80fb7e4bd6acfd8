#pragma once
/// Conversions between the program's internal units and the units of the input.
///
/// The internal units are the length r (radius), the mass ρr³ (ρ: density) and a time t. For an elastic ball without
/// self-gravity, t is r/c with the speed of shear waves c = √(μ/ρ). In the output, a quantity of dimension length^a
/// mass^b time^d is multiplied by r^a (ρr³)^b t^d, for example:
///   energies  mass·length²/time²            angular momentum J, circulation Z  mass·length²/time
///   Q̇  1/time                               multiplier λ per m̄ = tr E₀/3      1/time²
/// The matrix E₀ = ∫ρ X Xᵀ dX is the second moment of mass.

#include "entries/unit.h"

namespace pseudorigid::io {

/// The internal units of length, mass and time, measured in the units of the input. The functions return the internal
/// units of derived quantities, also measured in the units of the input.
struct Units {
  double length = 1, mass = 1, time = 1;

  double velocity() const { return length / time; }
  double energy() const { return mass * velocity() * velocity(); }
  double momentum() const { return mass * length * velocity(); }  ///< the unit of angular momentum and circulation
  double stress() const { return energy() / (length * length * length); }
  /// The unit of the multiplier of det Q = 1, divided by m̄ = tr E₀/3 with the second moment of mass E₀.
  double multiplier() const { return 1 / (time * time); }

  /// Converts a quantity with the given unit from internal units to the units of the input. The words `radius` and `1`
  /// do not change the number.
  double to_physical(double internal, scene::Unit unit) const;
  /// Converts a quantity with the given unit from the units of the input to internal units. It is the inverse of
  /// to_physical, up to round-off.
  double to_internal(double physical, scene::Unit unit) const;
};

/// The units of a ball with radius r and density ρ, both positive, and with the given unit of time (scene/scales.h).
Units ball_units(double radius, double density, double time);

}  // namespace pseudorigid::io
