#pragma once
/// Gent's law (Rubber Chem. Technol. 69 (1996) 59), for polymer chains of limited extension, per unit reference volume.
/// With the moduli λ and μ, the limit J_m, I = |F|², III = J², J = det F and d = I − 3 < J_m:
///
///   W = −(μ/2) J_m ln(1 − d/J_m) − μ ln J + (λ/4)(III − 1 − ln III)
///
/// With y = d/J_m and −ln(1 − y) = y + [−y − ln(1 − y)], this is Ciarlet–Geymonat's law W_CG (ciarlet_geymonat.h) plus
/// a term of second order in the strain. P_CG is the stress of W_CG:
///
///   W = W_CG(μ, λ) + (μ/2) J_m [−y − ln(1 − y)]
///   P = ∂W/∂F = P_CG + μ d/(J_m − d) F
///   DP(F)[H] = DP_CG(F)[H] + μ [J_m ḋ/(J_m − d)² F + d/(J_m − d) H],   ḋ = 2 F:H
///
/// The law is stress-free at Id. The shear modulus at Id is μ, and the first Lamé modulus is λ + 2μ/J_m. As J_m → ∞,
/// the law tends to the neo-Hookean law. W is infinite at d = J_m, so d ≥ J_m is not possible. For incompressible
/// bodies, F ∈ SL(3), the bulk term is 0 and therefore omitted: λ = 0.

#include <string_view>

#include "materials/ciarlet_geymonat.h"

namespace pseudorigid::materials {

struct Gent {
  double mu, lambda, J_m;
  bool operator==(const Gent&) const = default;

  /// Energy W(F) per reference volume; F must have J > 0 and a positive `reserve`.
  template <class T>
  T energy(const Tensor<T>& F) const {
    return first_part().energy(F) + 0.5 * mu * J_m * x_minus_log1p(-1.0 / J_m * trace_of_strain(F));
  }

  /// First Piola–Kirchhoff stress P = ∂W/∂F; F must have J > 0 and a positive `reserve`.
  template <class T>
  [[gnu::always_inline]] Tensor<T> stress(const Tensor<T>& F) const {
    const T d = trace_of_strain(F), stiffening = mu * d / (J_m - d);
    return entrywise([&](const T& p, const T& f) { return p + stiffening * f; }, first_part().stress(F), F);
  }

  /// Derivative DP(F)[H] of the stress along H; F must have J > 0 and a positive `reserve`.
  template <class T>
  [[gnu::always_inline]] Tensor<T> tangent(const Tensor<T>& F, const Tensor<T>& H) const {
    const T d = trace_of_strain(F), d_rate = 2.0 * dot(F, H), rest = J_m - d;
    const T stiffening = mu * d / rest, stiffening_rate = mu * J_m * d_rate / (rest * rest);
    return entrywise([&](const T& p, const T& f, const T& h) { return p + (stiffening_rate * f + stiffening * h); },
                     first_part().tangent(F, H), F, H);
  }

  /// Returns J_m − d. The law admits F if the reserve is positive.
  template <class T>
  [[gnu::always_inline]] T reserve(const Tensor<T>& F) const {
    return J_m - trace_of_strain(F);
  }
  static constexpr std::string_view limit = "I - 3 has reached Material/Gent limit";

 private:
  CiarletGeymonat first_part() const { return {mu, lambda}; }
};

}  // namespace pseudorigid::materials
