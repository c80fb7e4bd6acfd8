#pragma once
/// The Saint Venant–Kirchhoff law in the form printed in Oliva 5.7.9(3), per unit reference volume, with I = |F|² and
/// d = I − 3 = tr(FᵀF − Id):
///
///   W = (λ/2) d² + μ d
///   P = ∂W/∂F = 2(λd + μ) F
///   DP(F)[H] = 2(λd + μ) H + 4λ(F:H) F
///
/// In contrast to the standard law (saint_venant_kirchhoff.h), the stress at Id is not zero but 2μ Id. In an
/// incompressible body, F ∈ SL(3), the constraint balances this tension, and the shear modulus at rest is 2μ. A
/// compressible body contracts, because nothing balances the tension.

#include "materials/strain.h"

namespace pseudorigid::materials {

struct SaintVenantKirchhoffAsPrinted {
  double mu, lambda;
  bool operator==(const SaintVenantKirchhoffAsPrinted&) const = default;

  template <class T>
  T energy(const Tensor<T>& F) const {
    const T d = trace_of_strain(F);
    return (0.5 * lambda * d + mu) * d;
  }

  /// First Piola–Kirchhoff stress P = ∂W/∂F.
  template <class T>
  [[gnu::always_inline]] Tensor<T> stress(const Tensor<T>& F) const {
    return (2.0 * (lambda * trace_of_strain(F) + mu)) * F;
  }

  /// Derivative DP(F)[H] of the stress along H.
  template <class T>
  [[gnu::always_inline]] Tensor<T> tangent(const Tensor<T>& F, const Tensor<T>& H) const {
    const T s = 2.0 * (lambda * trace_of_strain(F) + mu), s_rate = 4.0 * lambda * dot(F, H);
    return entrywise([&](const T& h, const T& f) { return s * h + s_rate * f; }, H, F);
  }
};

}  // namespace pseudorigid::materials
