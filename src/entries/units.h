#pragma once
/// Conversions between the internal units of the program and the units of the user, in which parameter files and
/// results are written.
///
/// The internal units of a ball with the radius r and the density ρ are the length r, the mass ρr³ and a time t. For an
/// elastic ball without self-gravity, t is r/c with the speed of shear waves c = √(μ/ρ) and the shear modulus μ. In the
/// output, a quantity of dimension length^a mass^b time^d is multiplied by r^a (ρr³)^b t^d. Examples of dimensions are:
///   energies  mass·length²/time²            angular momentum, circulation  mass·length²/time
///   Q̇  1/time                               multiplier of det Q = 1 per m̄  1/time²
/// Q is the dimensionless deformation gradient of the pseudo-rigid body. m̄ = tr E₀/3, with the second moment of mass
/// E₀ = ∫ρ X Xᵀ dV of the reference body.

#include "entries/unit.h"

namespace pseudorigid::io {

/// The internal units of length, mass and time, expressed in the units of the user. The functions without arguments
/// return the internal units of derived quantities, also expressed in the units of the user.
struct Units {
  double length = 1, mass = 1, time = 1;

  double velocity() const { return length / time; }
  double energy() const { return mass * velocity() * velocity(); }
  double momentum() const { return mass * length * velocity(); }  ///< the unit of angular momentum and circulation
  double stress() const { return energy() / (length * length * length); }
  /// The unit of the multiplier of the constraint det Q = 1, divided by m̄.
  double multiplier() const { return 1 / (time * time); }

  /// Converts a quantity with the given unit from internal units to the units of the user. The words `radius` and `1`
  /// do not contribute a factor.
  double to_physical(double internal, scene::Unit unit) const;
  /// Converts a quantity with the given unit from the units of the user to internal units. This is the inverse of
  /// to_physical, up to round-off.
  double to_internal(double physical, scene::Unit unit) const;
};

/// The internal units of a ball with the given radius and density, both positive. `time` is the unit of time, which
/// scene/scales.h determines.
Units ball_units(double radius, double density, double time);

}  // namespace pseudorigid::io
