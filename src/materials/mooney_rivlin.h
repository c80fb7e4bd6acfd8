#pragma once
/// Mooney–Rivlin law with the Mooney fraction b in [0, 1], per unit reference volume. The symbols are I = |F|², II =
/// |cof F|², III = J², J = det F, D = FᵀF − Id, d = tr D:
///
///   W = (μ/2)[(1 − b)(I − 3) + b(II − 3)] − μ(1 + b) ln J + (λ/4)(III − 1 − ln III)
///
/// Since I − 3 = d and II − 3 = 2d + ½(d² − |D|²), this is Ciarlet–Geymonat's law W_CG with (1 + b)μ
/// (ciarlet_geymonat.h) plus a term of second order in the strain. P_CG is the stress of W_CG:
///
///   W = W_CG((1 + b)μ, λ) + (bμ/4)(d² − |D|²)
///   P = P_CG + bμ(d F − F D)
///   DP(F)[H] = DP_CG(F)[H] + bμ(ḋ F + d H − H D − F Ḋ),   Ḋ = HᵀF + FᵀH, ḋ = 2 F:H
///
/// The law is stress-free at Id. The shear modulus at Id is μ, and the first Lamé modulus is λ + 2bμ, because the term
/// in II also resists changes of volume. For incompressible bodies, F ∈ SL(3), the bulk term is 0 and therefore
/// omitted: λ = 0. For b = 0 the law is the neo-Hookean law.

#include "materials/ciarlet_geymonat.h"

namespace pseudorigid::materials {

struct MooneyRivlin {
  double mu, lambda, b;
  static constexpr double surface_limit = biot_ratio;  ///< for the law at J = 1 (law_limits.h)
  bool operator==(const MooneyRivlin&) const = default;

  /// Energy W(F) per reference volume; F must have J > 0.
  template <class T>
  T energy(const Tensor<T>& F) const {
    const Tensor<T> D = strain(F);
    const T d = trace(D);
    return first_part().energy(F) + 0.25 * b * mu * (d * d - dot(D, D));
  }

  /// First Piola–Kirchhoff stress P = ∂W/∂F; F must have J > 0.
  template <class T>
  [[gnu::always_inline]] Tensor<T> stress(const Tensor<T>& F) const {
    const Tensor<T> D = strain(F);
    const T d = trace(D);
    return entrywise([&](const T& p, const T& f, const T& fd) { return p + b * mu * (d * f - fd); },
                     first_part().stress(F), F, product(F, D));
  }

  /// Derivative DP(F)[H] of the stress along H; F must have J > 0.
  template <class T>
  [[gnu::always_inline]] Tensor<T> tangent(const Tensor<T>& F, const Tensor<T>& H) const {
    const Tensor<T> D = strain(F), D_rate = strain_rate(F, H);
    const T d = trace(D), d_rate = trace(D_rate);
    return entrywise([&](const T& p, const T& f, const T& h, const T& hd,
                         const T& fd) { return p + b * mu * ((d_rate * f + d * h) - (hd + fd)); },
                     first_part().tangent(F, H), F, H, product(H, D), product(F, D_rate));
  }

 private:
  CiarletGeymonat first_part() const { return {(1 + b) * mu, lambda}; }
};

}  // namespace pseudorigid::materials
