#pragma once
/// The elliptic integrals for the gravity of an ellipsoid with semi-axes a_i, in the notation R_F, R_D of Carlson. The
/// indices i, j, k are a permutation of 1, 2, 3. With x_i = a_i² and Δ = √((x_1+s)(x_2+s)(x_3+s)), the integrals are
///
///   d_i = R_D(x_j, x_k, x_i) = (3/2) ∫₀^∞ ds/((x_i + s)Δ),      t_k = (3/2) ∫₀^∞ ds/((x_i + s)(x_j + s)Δ).
///
/// Other integrals follow without cancellation: R_F = ⅓ Σ x_i d_i, (d_i − d_j)/(x_i − x_j) = −t_k, ∂d_i/∂x_j = −½ t_k.
///
/// Carlson's duplication (Numer. Math. 33 (1979) 1; Numer. Algorithms 10 (1995) 13) is used without his factor ¼. Let
/// r_i = √x_i and p_ij = r_i + r_j. A duplication replaces the arguments x_i by x_i' = x_i + r_1 r_2 + r_2 r_3 + r_3
/// r_1 = p_ij p_ik. The differences x_i − x_j do not change. With the integrals d_i' and t_k' of the new arguments,
///
///   d_i = 3/(r_i x_i') + 2 d_i',      t_k = 3 (r_1 + r_2 + r_3)/(p_ij² r_i r_j p_ik p_jk) + 2 t_k'.
///
/// Every term is positive, so there is no cancellation. If the ratio of the arguments is large, a duplication replaces
/// this ratio by about its square root. If the ratio is near 1, a duplication divides the relative differences by about
/// 4. After the duplications, let A = ⅓ Σ x_i and Z_i = 1 − x_i/A. The sum of the Z_i is 0, and E_2 = Σ_{i<j} Z_i Z_j
/// and E_3 = Z_1 Z_2 Z_3 are their elementary symmetric functions. Let P(u) = 1 + E_2/u² − E_3/u³. Let
/// (3/2)_k = (3/2)(5/2) … (k + 1/2). For small Z_i, the substitution u = 1 + s/A and an expansion in E_2, E_3 give
///
///   d_i = A^(−3/2) (h_0 + Z_i h_1 + Z_j Z_k h_2),    t_k = A^(−5/2) (h_1 − Z_k h_2),
///   h_l = (3/2) ∫₁^∞ u^(−5/2−l) P^(−3/2) du = Σ_{m,n} (−1)^m (3/2)_{m+n} E_2^m E_3^n / (m! n! (1 + ⅔(l + 2m + 3n))).

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

namespace pseudorigid::gravity {

/// The integrals d_i and t_k for i, k = 1, 2, 3.
struct EllipsoidIntegrals {
  Eigen::Vector3d d, t;
};

namespace detail {

/// The series for h_l is truncated after the degree `series_degree` − l in Z. The terms of d_i are then complete up to
/// the degree `series_degree`, and the terms of t_k up to one degree less. The series is used if the largest and the
/// smallest argument x_i differ by at most `series_spread` times the sum of the arguments. The relative truncation
/// error is below 1e-16 (measured: 4e-17 in d_i, 6e-17 in t_k).
inline constexpr int series_degree = 11;
inline constexpr double series_spread = 0.025;

/// The factor of E_2^m E_3^n in h_l, equal to (−1)^m (3/2)_{m+n} / (m! n! (1 + ⅔(l + 2m + 3n)))
template <int l, int m, int n>
inline constexpr double series_coefficient = [] {
  double c = 1 / (1 + 2.0 / 3 * (l + 2 * m + 3 * n));
  for (int i = 0; i < m + n; ++i) c *= 1.5 + i;
  for (int i = 1; i <= m; ++i) c /= -i;
  for (int i = 1; i <= n; ++i) c /= i;
  return c;
}();

/// Returns the factor of E_3^n in h_l, a polynomial in E_2 with the powers m = 0, …, M, by Horner's rule.
template <int l, int n, int... m>
double series_row(double E2, std::integer_sequence<int, m...>) {
  constexpr int M = sizeof...(m) - 1;
  double sum = 0;
  ((sum = sum * E2 + series_coefficient<l, M - m, n>), ...);
  return sum;
}
/// Returns the truncated series h_l, a polynomial in E_3 with the powers n = 0, …, N, by Horner's rule.
template <int l, int... n>
double series_rows(double E2, double E3, std::integer_sequence<int, n...>) {
  constexpr int N = sizeof...(n) - 1;
  double sum = 0;
  ((sum = sum * E3 +
          series_row<l, N - n>(E2, std::make_integer_sequence<int, (series_degree - l - 3 * (N - n)) / 2 + 1>())),
   ...);
  return sum;
}

/// Returns the truncated series h_l. The compiler unrolls the sums, so that the processor can compute several rows
/// (series_row) in parallel.
template <int l>
double series(double E2, double E3) {
  return series_rows<l>(E2, E3, std::make_integer_sequence<int, (series_degree - l) / 3 + 1>());
}

}  // namespace detail

/// Returns the integrals for semi-axes a_i, each 0 or between 10⁻⁵⁰ and 10⁵⁰. At most one semi-axis may be 0. If
/// a_i = 0, d_i and the t_k with k ≠ i are infinite. If `with_t` is false, t is not computed and must not be used.
template <bool with_t = true>
EllipsoidIntegrals ellipsoid_integrals(const Eigen::Vector3d& a) {
  using Eigen::Array3d;
  constexpr int max_duplications = 20;  // 14 are sufficient if the ratio of the largest to the smallest x_i is 10³⁰⁰
  const auto others = [](const Array3d& y) { return Array3d(y[1] * y[2], y[2] * y[0], y[0] * y[1]); };
  Array3d r = a, x = r * r, d = Array3d::Zero(), t = Array3d::Zero();
  double weight = 3;  // factor of the terms, 3·2ⁿ after n duplications
  const auto is_wide = [&x] {
    const double largest = std::max(std::max(x[0], x[1]), x[2]), smallest = std::min(std::min(x[0], x[1]), x[2]);
    return largest - smallest > detail::series_spread * (x[0] + x[1] + x[2]);
  };
  for (int n = 0; n < max_duplications && is_wide(); ++n) {
    const Array3d p(r[1] + r[2], r[2] + r[0], r[0] + r[1]);
    x = others(p);
    d += weight / (r * x);
    if constexpr (with_t) t += weight * (r[0] + r[1] + r[2]) / (p * p * others(r) * x);
    r = x.sqrt();
    weight *= 2;
  }
  const double A = (x[0] + x[1] + x[2]) / 3, inverse = 1 / A, factor = weight / 3 / (A * std::sqrt(A));
  const Array3d Z = 1 - x * inverse;
  const double E2 = Z[0] * Z[1] + Z[2] * (Z[0] + Z[1]), E3 = Z[0] * Z[1] * Z[2];
  const double h0 = factor * detail::series<0>(E2, E3), h1 = factor * detail::series<1>(E2, E3),
               h2 = factor * detail::series<2>(E2, E3);
  d += h0 + Z * h1 + others(Z) * h2;
  if constexpr (with_t) t += (h1 - Z * h2) * inverse;
  return {d, t};
}

}  // namespace pseudorigid::gravity
