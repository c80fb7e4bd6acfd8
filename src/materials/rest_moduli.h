#pragma once
/// Moduli of small motions about rest, F = Id. At rest the law may have a stress P(Id) = p Id, which the constraint of
/// an incompressible body balances. The second variation C(H) of W − p ln J is the derivative of its stress along H,
///
///   C(H) = DP(Id)[H] + p Hᵀ  (incompressible),      C(H) = DP(Id)[H]  (compressible; Id is at rest only if p = 0).
///
/// The moduli follow from the stiffness H : C(H). The stiffness is μ for the shear H = e₁⊗e₂, and λ + 2μ for the
/// stretch H = e₁⊗e₁.

#include <variant>

#include "materials/law_table.h"

namespace pseudorigid::materials {

/// Returns the number p of the stress P(Id) = p Id at rest. Isotropic laws have a stress of this form.
inline double pressure_at_rest(const AnyLaw& law) {
  constexpr Tensor<double> Id{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  return std::visit([&](const auto& known) { return trace(known.stress(Id)) / 3; }, law);
}

/// Returns the second variation C(H) at F = Id.
inline Tensor<double> tangent_at_rest(const AnyLaw& law, bool incompressible, const Tensor<double>& H) {
  constexpr Tensor<double> Id{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Tensor<double> C = std::visit([&](const auto& known) { return known.tangent(Id, H); }, law);
  if (!incompressible) return C;
  const double p = pressure_at_rest(law);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) C(i, j) += p * H(j, i);
  return C;
}

/// Lamé's moduli at rest. For an incompressible body only μ has a meaning, because λ multiplies tr H, which is 0.
struct RestModuli {
  double shear, lame;
};
/// Returns the moduli from C at F = Id. If a compressible body has a stress at Id, its state of rest is not Id and has
/// other moduli.
inline RestModuli moduli_at_rest(const AnyLaw& law, bool incompressible) {
  constexpr Tensor<double> shear{{{0, 1, 0}, {0, 0, 0}, {0, 0, 0}}}, stretch{{{1, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
  const double mu = tangent_at_rest(law, incompressible, shear)(0, 1);
  return {mu, tangent_at_rest(law, incompressible, stretch)(0, 0) - 2 * mu};
}

}  // namespace pseudorigid::materials
