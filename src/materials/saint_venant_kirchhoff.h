#pragma once
/// Saint Venant–Kirchhoff law (Oliva 5.7.9(3), in its standard form; Ciarlet, Mathematical Elasticity I, 3.9), per unit
/// reference volume. The symbols are I = |F|², II = |cof F|², D = FᵀF − Id (twice Green's strain E), d = tr D:
///
///   W = (λ/8)(I − 3)² + (μ/4)(I² − 2II − 2I + 3) = (λ/8) d² + (μ/4)|D|² = (λ/2)(tr E)² + μ|E|²
///   P = ∂W/∂F = F((λ/2) d Id + μD)
///   DP(F)[H] = H((λ/2) d Id + μD) + F((λ/2) ḋ Id + μḊ),   Ḋ = HᵀF + FᵀH, ḋ = 2 F:H
///
/// The law is stress-free at Id, with Lamé's moduli λ, μ. W is a polynomial and does not prevent J ≤ 0. If the body is
/// compressed along one axis to a stretch below 1/√3, its resistance decreases with further compression, and the law
/// loses stability. Incompressible motions also depend on λ, because I − 3 is not constant on SL(3).

#include "materials/strain.h"

namespace pseudorigid::materials {

struct SaintVenantKirchhoff {
  double mu, lambda;
  bool operator==(const SaintVenantKirchhoff&) const = default;

  template <class T>
  T energy(const Tensor<T>& F) const {
    const Tensor<T> D = strain(F);
    const T d = trace(D);
    return 0.125 * lambda * d * d + 0.25 * mu * dot(D, D);
  }

  /// First Piola–Kirchhoff stress P = ∂W/∂F.
  template <class T>
  [[gnu::always_inline]] Tensor<T> stress(const Tensor<T>& F) const {
    return product(F, second_stress(strain(F)));
  }

  /// Derivative DP(F)[H] of the stress along H.
  template <class T>
  [[gnu::always_inline]] Tensor<T> tangent(const Tensor<T>& F, const Tensor<T>& H) const {
    return entrywise([](const T& a, const T& b) { return a + b; }, product(H, second_stress(strain(F))),
                     product(F, second_stress(strain_rate(F, H))));
  }

 private:
  /// Returns the second Piola–Kirchhoff stress λ tr E Id + 2μE, which is linear in the argument D = 2E.
  template <class T>
  [[gnu::always_inline]] Tensor<T> second_stress(const Tensor<T>& D) const {
    const T mean = 0.5 * lambda * trace(D);
    return {{{mean + mu * D(0, 0), mu * D(0, 1), mu * D(0, 2)},
             {mu * D(1, 0), mean + mu * D(1, 1), mu * D(1, 2)},
             {mu * D(2, 0), mu * D(2, 1), mean + mu * D(2, 2)}}};
  }
};

}  // namespace pseudorigid::materials
