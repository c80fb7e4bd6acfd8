#pragma once
/// The elliptic integrals of an ellipsoid with semi-axes a_i, x_i = a_i², Δ = √((x_1+s)(x_2+s)(x_3+s)), all at once:
///
///   d_i = R_D(x_j, x_k, x_i) = (3/2) ∫₀^∞ ds/((x_i + s)Δ),      t_k = (3/2) ∫₀^∞ ds/((x_i + s)(x_j + s)Δ).
///
/// The others follow without loss: R_F = ⅓ Σ x_i d_i, (d_i − d_j)/(x_i − x_j) = −t_k, ∂d_i/∂x_j = −½ t_k.
///
/// Carlson's duplication (Numer. Math. 33 (1979) 1; Numer. Algorithms 10 (1995) 13), without his factor ¼: with r_i =
/// √x_i and p_ij = r_i + r_j the arguments x_i' = x_i + λ are p_ij p_ik, their differences are those of the x_i, and
///
///   d_i = 3/(r_i x_i') + 2 d_i',      t_k = 3 (r_1 + r_2 + r_3)/(p_ij² r_i r_j p_ik p_jk) + 2 t_k'.
///
/// Every term is positive. The ratio of the arguments falls to its square root while it is large, later their relative
/// differences fall to a quarter. When these are small, with A = ⅓ Σ x_i, Z_i = 1 − x_i/A, E_2 = Σ_{i<j} Z_i Z_j,
/// E_3 = Z_1 Z_2 Z_3 and P(u) = 1 + E_2/u² − E_3/u³, expanding the integrals over u = 1 + s/A gives
///
///   d_i = A^(−3/2) (h_0 + Z_i h_1 + Z_j Z_k h_2),    t_k = A^(−5/2) (h_1 − Z_k h_2),
///   h_l = (3/2) ∫₁^∞ u^(−5/2−l) P^(−3/2) du = Σ_{m,n} (−1)^m (3/2)_{m+n} E_2^m E_3^n / (m! n! (1 + ⅔(l + 2m + 3n))).

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

namespace pseudorigid::reduced {

struct EllipsoidIntegrals {
  Eigen::Vector3d d, t;
};

namespace detail {

/// Terms of the h_l up to this degree in Z, and the largest spread of the arguments, in units of their sum, at which
/// they suffice: what they leave out is then below 10⁻¹⁷ (measured against 50 digits).
inline constexpr int series_degree = 11;
inline constexpr double series_spread = 0.02;

/// (−1)^m (3/2)_{m+n} / (m! n! (1 + ⅔(l + 2m + 3n))), the factor of E_2^m E_3^n in h_l
constexpr double series_coefficient(int l, int m, int n) {
  double c = 1 / (1 + 2.0 / 3 * (l + 2 * m + 3 * n));
  for (int i = 0; i < m + n; ++i) c *= 1.5 + i;
  for (int i = 1; i <= m; ++i) c /= -i;
  for (int i = 1; i <= n; ++i) c /= i;
  return c;
}

/// h_0, h_1, h_2 by Horner's rule in E_2, then in E_3
inline std::array<double, 3> series(double E2, double E3) {
  static constexpr auto c = [] {
    std::array<std::array<std::array<double, 3>, series_degree / 2 + 1>, series_degree / 3 + 1> table{};
    for (int n = 0; n <= series_degree / 3; ++n)
      for (int m = 0; m <= (series_degree - 3 * n) / 2; ++m)
        for (int l = 0; l < 3; ++l) table[n][m][l] = series_coefficient(l, m, n);
    return table;
  }();
  std::array<double, 3> h{};
  for (int n = series_degree / 3; n >= 0; --n) {
    std::array<double, 3> in_E2{};
    for (int m = (series_degree - 3 * n) / 2; m >= 0; --m)
      for (int l = 0; l < 3; ++l) in_E2[l] = in_E2[l] * E2 + c[n][m][l];
    for (int l = 0; l < 3; ++l) h[l] = h[l] * E3 + in_E2[l];
  }
  return h;
}

}  // namespace detail

/// The integrals of semi-axes a_i ≥ 0 of order 1 at most. Two axes that vanish give infinity.
inline EllipsoidIntegrals ellipsoid_integrals(const Eigen::Vector3d& a) {
  constexpr int max_duplications = 20;  // a ratio of 10³⁰⁰ takes 14
  double r[3] = {a[0], a[1], a[2]}, x[3] = {a[0] * a[0], a[1] * a[1], a[2] * a[2]};
  double d[3] = {0, 0, 0}, t[3] = {0, 0, 0}, weight = 1;
  const auto spread = [&] { return std::max({x[0], x[1], x[2]}) - std::min({x[0], x[1], x[2]}); };
  for (int n = 0; n < max_duplications && spread() > detail::series_spread * (x[0] + x[1] + x[2]); ++n) {
    const double p[3] = {r[1] + r[2], r[2] + r[0], r[0] + r[1]}, sum = 3 * weight * (r[0] + r[1] + r[2]);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      x[i] = p[j] * p[k];
      d[i] += 3 * weight / (r[i] * x[i]);
      t[i] += sum / (p[i] * p[i] * (r[j] * r[k]) * (p[j] * p[k]));
    }
    for (int i = 0; i < 3; ++i) r[i] = std::sqrt(x[i]);
    weight *= 2;
  }
  const double A = (x[0] + x[1] + x[2]) / 3, Z[3] = {1 - x[0] / A, 1 - x[1] / A, 1 - x[2] / A};
  const auto h = detail::series(Z[0] * Z[1] + Z[2] * (Z[0] + Z[1]), Z[0] * Z[1] * Z[2]);
  const double factor = weight / (A * std::sqrt(A));
  EllipsoidIntegrals result;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    result.d[i] = d[i] + factor * (h[0] + Z[i] * h[1] + Z[j] * Z[k] * h[2]);
    result.t[i] = t[i] + factor / A * (h[1] - Z[i] * h[2]);
  }
  return result;
}

}  // namespace pseudorigid::reduced
