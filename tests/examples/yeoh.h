#pragma once
/// Yeoh's law to second order (Rubber Chem. Technol. 63 (1990) 792; the term of third order is left out), per unit
/// reference volume, with the stiffening s ≥ 0; I = |F|², III = J², d = I − 3:
///
///   W = (μ/2)[d + (s/2) d²] − μ ln J + (λ/4)(III − 1 − ln III)
///
/// This is Ciarlet–Geymonat's law and a term of second order in the strain:
///
///   W = W_CG(μ, λ) + (μs/4) d²
///   P = ∂W/∂F = P_CG + μs d F
///   DP(F)[H] = DP_CG(F)[H] + μs(ḋ F + d H),   ḋ = 2 F:H
///
/// Stress-free at Id. The shear modulus there is μ, and the first Lamé modulus λ + 2sμ. s = 0 is the neo-Hookean law.

#include "materials/ciarlet_geymonat.h"

namespace pseudorigid::materials {

struct Yeoh {
  double mu, lambda, s;
  bool operator==(const Yeoh&) const = default;

  /// W(F); F must have J > 0.
  template <class T>
  T energy(const Tensor<T>& F) const {
    const T d = trace_of_strain(F);
    return first_part().energy(F) + 0.25 * mu * s * (d * d);
  }

  /// First Piola–Kirchhoff stress P = ∂W/∂F.
  template <class T>
  [[gnu::always_inline]] Tensor<T> stress(const Tensor<T>& F) const {
    const T d = trace_of_strain(F);
    return entrywise([&](const T& p, const T& f) { return p + mu * s * (d * f); }, first_part().stress(F), F);
  }

  /// DP(F)[H].
  template <class T>
  [[gnu::always_inline]] Tensor<T> tangent(const Tensor<T>& F, const Tensor<T>& H) const {
    const T d = trace_of_strain(F), d_rate = 2.0 * dot(F, H);
    return entrywise([&](const T& p, const T& f, const T& h) { return p + mu * s * (d_rate * f + d * h); },
                     first_part().tangent(F, H), F, H);
  }

 private:
  CiarletGeymonat first_part() const { return {mu, lambda}; }
};

}  // namespace pseudorigid::materials
