#pragma once
/// The energy per reference volume that the finite elements store: W of the law, and the energy U of the volumetric
/// stabilisation with the stiffness κ (materials/volumetric_energy.h),
///
///   W(F) + U(J),   U(J) = (κ/8)(J − 1/J)²,   J = det F.
///
/// U grows like 1/J² as J → 0, so it resists the inversion of an element. In two test motions with large deformations,
/// the least J was 0.28 and 0.32. With the energy (κ/4)(J² − 1 − ln J²), which has the same stiffness at J = 1, the
/// least J was 0.11 and 0.07.
///
/// The energies U_m = (κ/8m²)(Jᵐ − J⁻ᵐ)² have the same stiffness, and U_1 = U. Three violent releases were run with m =
/// 2, 4 or 8. The least J increased, but a run needed 1.3 to 3.4 times as many forces. The drift of the energy was 1.5
/// to 4.7 times as large.
///
/// U and its first derivative are 0 if J = 1, so that U does not change an exact incompressible motion. In discrete
/// motions, J ≠ 1 at some points. The second variation of the multiplier's term ∫λ_h ln J dX along a displacement u can
/// then be negative. The second variation of U, about ∫κ (div u)² dX for J ≈ 1, is positive and counteracts this. A
/// body needs U under self-gravity, in strong motions, and always if it is a fluid (W = 0).
///
/// A nearly incompressible body can have its bulk term B (materials/bulk_energy.h) at a projection of ln J. With the
/// functions ψ_j of the multiplier and g_j = ∫ψ_j ln J dX, the projection is θ = Σ g_j ψ_j. The body then stores ∫B(θ)
/// dX, and W is the law without its bulk term.

#include <concepts>

#include "materials/law_table.h"

namespace pseudorigid::continuum {

struct StoredEnergy {
  /// A material law with the stiffness κ of the stabilisation. By default there is no stabilisation.
  template <std::convertible_to<materials::AnyLaw> Law>
  StoredEnergy(const Law& l, double kappa = 0, double lambda = 0)
      : law(l), volumetric_stiffness(kappa), projected_bulk(lambda) {}

  materials::AnyLaw law;
  double volumetric_stiffness;  ///< stiffness κ of U
  double projected_bulk;        ///< modulus λ of the projected bulk term B; 0 if there is none
};

}  // namespace pseudorigid::continuum
