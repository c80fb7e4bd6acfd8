#pragma once
/// The stress at a quadrature point as a function of H = ∂x/∂ξ, and the geometry of the point that this function needs.
/// Each SIMD lane has one cell. The integrand of the elastic force at the point is
///
///   T = −w ∂(W + U)/∂F (∂X/∂ξ)⁻ᵀ,   F = H (∂X/∂ξ)⁻¹,   J = det F,   w = ŵ det ∂X/∂ξ
///
/// with the energy W of the law, the weight ŵ on the reference cell and the stabilising energy U = (κ/8)(J − 1/J)². For
/// a general law a point stores ten numbers, (∂X/∂ξ)⁻¹ and w. If ∂W/∂F = a F + c cof F, with functions a and c of J
/// (materials/stress_coefficients.h), seven numbers are sufficient. Because cof F (∂X/∂ξ)⁻ᵀ = cof H / det ∂X/∂ξ, the
/// stress is then
///
///   T = −a H G − ŵ (c + (κ/4)(J − 1/J³)) cof H,   J = D det H,
///   G = w (∂X/∂ξ)⁻¹ (∂X/∂ξ)⁻ᵀ,   D = 1 / det ∂X/∂ξ

#include <type_traits>

#include "materials/law_limits.h"
#include "materials/stress_coefficients.h"
#include "materials/tensor.h"
#include "materials/volumetric_energy.h"

namespace pseudorigid::continuum {

/// Geometry and stress of a point for any law. The geometry consists of the ten numbers of (∂X/∂ξ)⁻¹ and w.
template <class L>
struct AnyStressPoint {
  using Tensor = materials::Tensor<L>;

  /// `jacobian` is ∂X/∂ξ, and `unit_weight` is ŵ.
  AnyStressPoint(const Tensor& jacobian, double unit_weight) {
    const Tensor cof = materials::cofactor(jacobian);
    const L det = materials::determinant(jacobian, cof);
    for (int k = 0; k < 9; ++k) inverse[k] = cof(k % 3, k / 3) / det;
    weight = unit_weight * det;
  }

  /// Returns T for κ = `kappa`. Sets `least` to the minimum of `least`, J and the reserve of the law
  /// (materials/law_limits.h).
  template <class Law>
  [[gnu::always_inline]] Tensor stress(const Law& law, double kappa, double, const Tensor& H, L& least) const {
    const Tensor F = times_inverse(H);
    least = min(materials::determinant(F), least);
    if constexpr (materials::is_limited<Law>) least = min(law.reserve(F), least);
    Tensor P = -weight * law.stress(F);
    if (kappa != 0) {
      const Tensor cof = materials::cofactor(F);
      const L pressure = weight * materials::volumetric_pressure(kappa, materials::determinant(F, cof));
      P = materials::entrywise([&](const L& p, const L& c) { return p - pressure * c; }, P, cof);
    }
    return times_inverse_transposed(P);
  }

  L inverse[9];  ///< entries of (∂X/∂ξ)⁻¹, row by row
  L weight;      ///< w = ŵ det ∂X/∂ξ

 private:
  [[gnu::always_inline]] Tensor times_inverse(const Tensor& A) const {
    const L* row = inverse;
    const auto entry = [&](int i, int j) { return A(i, 0) * row[j] + A(i, 1) * row[3 + j] + A(i, 2) * row[6 + j]; };
    return {{{entry(0, 0), entry(0, 1), entry(0, 2)},
             {entry(1, 0), entry(1, 1), entry(1, 2)},
             {entry(2, 0), entry(2, 1), entry(2, 2)}}};
  }
  [[gnu::always_inline]] Tensor times_inverse_transposed(const Tensor& A) const {
    const auto entry = [&](int i, int d) {
      const L* row = inverse + 3 * d;
      return A(i, 0) * row[0] + A(i, 1) * row[1] + A(i, 2) * row[2];
    };
    return {{{entry(0, 0), entry(0, 1), entry(0, 2)},
             {entry(1, 0), entry(1, 1), entry(1, 2)},
             {entry(2, 0), entry(2, 1), entry(2, 2)}}};
  }
};

/// Geometry and stress of a point for a law with stress coefficients. The geometry consists of the seven numbers of D
/// and the symmetric G.
template <class L>
struct MetricStressPoint {
  using Tensor = materials::Tensor<L>;

  MetricStressPoint(const Tensor& jacobian, double unit_weight) {
    const Tensor cof = materials::cofactor(jacobian);
    inverse_determinant = 1.0 / materials::determinant(jacobian, cof);
    const L factor = unit_weight * inverse_determinant;
    const auto entry = [&](int i, int j) {
      return factor * (cof(0, i) * cof(0, j) + cof(1, i) * cof(1, j) + cof(2, i) * cof(2, j));
    };
    G00 = entry(0, 0), G01 = entry(0, 1), G02 = entry(0, 2), G11 = entry(1, 1), G12 = entry(1, 2), G22 = entry(2, 2);
  }

  /// Like AnyStressPoint::stress, returns T and updates `least`.
  template <class Law>
  [[gnu::always_inline]] Tensor stress(const Law& law, double kappa, double unit_weight, const Tensor& H,
                                       L& least) const {
    static_assert(!materials::is_limited<Law>, "a law with stress coefficients has no limit but J > 0");
    const Tensor cof = materials::cofactor(H);
    const L J = inverse_determinant * materials::determinant(H, cof);
    least = min(J, least);
    const auto [of_F, of_cofactor] = law.stress_coefficients(J);
    const L a = -of_F;
    L c = -unit_weight * of_cofactor;
    if (kappa != 0) c = c - unit_weight * materials::volumetric_pressure(kappa, J);
    const auto row = [&](int i, L(&T)[3]) {
      const L h0 = a * H(i, 0), h1 = a * H(i, 1), h2 = a * H(i, 2);
      T[0] = h0 * G00 + h1 * G01 + h2 * G02 + c * cof(i, 0);
      T[1] = h0 * G01 + h1 * G11 + h2 * G12 + c * cof(i, 1);
      T[2] = h0 * G02 + h1 * G12 + h2 * G22 + c * cof(i, 2);
    };
    Tensor T;
    for (int i = 0; i < 3; ++i) row(i, T.a[i]);
    return T;
  }

  L G00, G01, G02, G11, G12, G22;
  L inverse_determinant;  ///< D = 1 / det ∂X/∂ξ
};

template <class Law, class L>
using StressPoint =
    std::conditional_t<materials::has_stress_coefficients<Law>, MetricStressPoint<L>, AnyStressPoint<L>>;

}  // namespace pseudorigid::continuum
