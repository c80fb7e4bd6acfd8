#pragma once
/// The energy that the finite elements store per reference volume: that of the law and the volumetric stabilisation,
///
///   W(F) + U(J),   U(J) = (κ/4)(J² − 1 − ln J²),   ∂U/∂F = (κ/2)(J − 1/J) cof F,   J = det F.
///
/// U and its first derivative are 0 if J = 1, so that an exact incompressible motion does not feel it. If the
/// pressure space leaves J ≠ 1, the second variation κ (div u)² counteracts that of the multiplier, which has no sign:
/// under self-gravity, in strong motions, and always in a fluid, W = 0.

#include <concepts>

#include "materials/law_table.h"

namespace pseudorigid::continuum {

struct StoredEnergy {
  /// A law as it is.
  template <std::convertible_to<materials::AnyLaw> Law>
  StoredEnergy(const Law& l, double kappa = 0) : law(l), volumetric_stiffness(kappa) {}

  materials::AnyLaw law;
  double volumetric_stiffness;  ///< κ
};

}  // namespace pseudorigid::continuum
