#pragma once
/// Ciarlet–Geymonat law (Oliva 5.7.9(2), with the standard coefficient λ/4; Ciarlet, Mathematical Elasticity I, 4.10),
/// per unit reference volume. With the Lamé moduli λ and μ, I = |F|², III = J² and J = det F:
///
///   W = (λ/4)(III − 1 − ln III) + (μ/2)(I − 3 − ln III)
///   P = ∂W/∂F = μ(F − F⁻ᵀ) + (λ/2)(J² − 1) F⁻ᵀ = μF + s cof F,   s(J) = [(λ/2)(J² − 1) − μ]/J
///   DP(F)[H] = μH + s′(J)(cof F : H) cof F + s D(cof)(F)[H],   s′ = [(λ/2)(J² + 1) + μ]/J²
///
/// Oliva prints λ/2 in place of λ/4. The printed law is therefore this law with 2λ instead of λ. Its name in
/// law_table.h is `ciarlet-geymonat (as printed)`.
///
/// The neo-Hookean law is W = (μ/2)(I − 3 − 2 ln J), plus the bulk term (λ/4)(III − 1 − ln III) for compressible
/// bodies, F ∈ GL⁺(3). For these bodies it is the same function as this law. For incompressible bodies, F ∈ SL(3), this
/// struct with λ = 0 is the neo-Hookean law. These laws are stress-free at Id.
///
/// The energy is computed from H = F − Id, because the formula for W has cancellation for small strains. With II(H) =
/// tr cof H and δ = J − 1 = tr H + II(H) + det H,
///   I − 3 − ln III = |H|² − 2(II(H) + det H) + 2(δ − ln(1 + δ)).

#include "materials/law_limits.h"
#include "materials/scalar.h"
#include "materials/strain.h"
#include "materials/stress_coefficients.h"
#include "materials/tensor.h"

namespace pseudorigid::materials {

struct CiarletGeymonat {
  double mu, lambda;
  static constexpr double surface_limit = biot_ratio;  ///< for the law at J = 1, which is neo-Hookean (law_limits.h)
  bool operator==(const CiarletGeymonat&) const = default;

  /// Energy W(F) per reference volume; F must have J > 0.
  template <class T>
  T energy(const Tensor<T>& F) const {
    const Tensor<T> H = displacement_gradient(F), cof = cofactor(H);
    const T second_and_det = trace(cof) + determinant(H, cof);
    const T delta = trace(H) + second_and_det;
    const T excess = x_minus_log1p(delta);  // (J² − 1 − ln J²) / 2 = excess + δ²/2
    return 0.5 * mu * (dot(H, H) - 2.0 * second_and_det + 2.0 * excess) +
           0.25 * lambda * (2.0 * excess + delta * delta);
  }

  /// First Piola–Kirchhoff stress P = ∂W/∂F; F must have J > 0.
  template <class T>
  [[gnu::always_inline]] Tensor<T> stress(const Tensor<T>& F) const {
    const Tensor<T> cof = cofactor(F);
    const StressCoefficients<T> by = stress_coefficients(determinant(F, cof));
    return entrywise([&](const T& f, const T& c) { return by.of_F * f + by.of_cofactor * c; }, F, cof);
  }

  /// Returns the coefficients μ of F and s(J) of cof F in the stress. If T is double and J is 1 up to round-off, s(1)
  /// is returned (settled_at_one).
  template <class T>
  [[gnu::always_inline]] StressCoefficients<T> stress_coefficients(const T& det_F) const {
    const T J = settled_at_one(det_F);
    return {T(mu), (0.5 * lambda * (J * J - 1.0) - mu) / J};
  }

  /// Derivative DP(F)[H] of the stress along H; F must have J > 0.
  template <class T>
  [[gnu::always_inline]] Tensor<T> tangent(const Tensor<T>& F, const Tensor<T>& H) const {
    const Tensor<T> cof = cofactor(F);
    const T J = determinant(F, cof);
    const T s = (0.5 * lambda * (J * J - 1.0) - mu) / J;
    const T s_rate = (0.5 * lambda * (J * J + 1.0) + mu) / (J * J) * dot(cof, H);
    return entrywise([&](const T& h, const T& c, const T& c_rate) { return mu * h + s_rate * c + s * c_rate; }, H, cof,
                     cofactor_derivative(F, H));
  }
};

}  // namespace pseudorigid::materials
