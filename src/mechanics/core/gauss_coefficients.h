#pragma once
/// Coefficients of Gauss collocation with 8 stages (Hairer, Lubich, Wanner, Geometric Numerical Integration, II.1),
/// computed by the compiler in extended precision. With Legendre's polynomials P_k on [0, 1], the nodes c_i, the
/// weights b_j, the Lagrange polynomials ℓ_j and the coefficients a_ij satisfy
///
///   P_8(c_i) = 0,   b_j = weight of c_j,   ℓ_j(x) = b_j Σ_{k<8} (2k+1) P_k(c_j) P_k(x),
///   a_ij = ∫₀^{c_i} ℓ_j = b_j [c_i + ½ Σ_{k=1}^{7} P_k(c_j) (P_{k+1}(c_i) − P_{k−1}(c_i))].

#include <array>

namespace pseudorigid::mechanics::gauss {

inline constexpr int n_stages = 8;

using Real = long double;
using OfStages = std::array<Real, n_stages>;
using Matrix = std::array<OfStages, n_stages>;

/// Returns P_0(x), …, P_8(x).
constexpr std::array<Real, n_stages + 1> legendre(Real x) {
  const Real y = 2 * x - 1;
  std::array<Real, n_stages + 1> P{1, y};
  for (int k = 1; k < n_stages; ++k) P[k + 1] = ((2 * k + 1) * y * P[k] - k * P[k - 1]) / (k + 1);
  return P;
}

namespace detail {

/// Returns the derivative dP_8/dy at y = 2x − 1, for |y| < 1. P contains P_0(x), …, P_8(x).
constexpr Real slope(Real y, const std::array<Real, n_stages + 1>& P) {
  return n_stages * (y * P[n_stages] - P[n_stages - 1]) / (y * y - 1);
}

/// Returns the nodes c_i, by Newton's iteration from guesses of y = 2c − 1. The nodes are symmetric about ½, so four
/// guesses suffice.
constexpr OfStages make_nodes() {
  constexpr Real guess[n_stages / 2]{0.96L, 0.797L, 0.526L, 0.183L};
  OfStages c{};
  for (int i = 0; i < n_stages / 2; ++i) {
    Real y = guess[i];
    for (int n = 0; n < 7; ++n) {
      const auto P = legendre((1 + y) / 2);
      y -= P[n_stages] / slope(y, P);
    }
    c[n_stages - 1 - i] = (1 + y) / 2;
    c[i] = (1 - y) / 2;
  }
  return c;
}

constexpr OfStages make_weights(const OfStages& c) {
  OfStages b{};
  for (int i = 0; i < n_stages; ++i) {
    const Real y = 2 * c[i] - 1, d = slope(y, legendre(c[i]));
    b[i] = 1 / ((1 - y * y) * d * d);
  }
  return b;
}

constexpr Matrix make_integrals(const OfStages& c, const OfStages& b) {
  Matrix a{};
  for (int i = 0; i < n_stages; ++i) {
    const auto at_i = legendre(c[i]);
    for (int j = 0; j < n_stages; ++j) {
      const auto at_j = legendre(c[j]);
      Real sum = c[i];
      for (int k = 1; k < n_stages; ++k) sum += at_j[k] * (at_i[k + 1] - at_i[k - 1]) / 2;
      a[i][j] = b[j] * sum;
    }
  }
  return a;
}

constexpr Matrix make_square(const Matrix& a) {
  Matrix s{};
  for (int i = 0; i < n_stages; ++i)
    for (int j = 0; j < n_stages; ++j)
      for (int k = 0; k < n_stages; ++k) s[i][j] += a[i][k] * a[k][j];
  return s;
}

}  // namespace detail

/// The nodes c_i, the weights b_j, and the coefficients a[i][j] = a_ij.
inline constexpr OfStages c = detail::make_nodes();
inline constexpr OfStages b = detail::make_weights(c);
inline constexpr Matrix a = detail::make_integrals(c, b);
/// The square of the matrix A = (a_ij). Consider a step of size h from the position q with the velocity v. With the
/// accelerations a_j of its stages, the positions of the stages are q_i = q + h c_i v + h² Σ_j (A²)_ij a_j.
inline constexpr Matrix a_squared = detail::make_square(a);

namespace detail {
/// Returns the matrix with the entries e_jk = b_j (2k+1) P_k(c_j). Row j has the coefficients of ℓ_j in the basis P_0,
/// …, P_7.
constexpr Matrix make_expansions() {
  Matrix e{};
  for (int j = 0; j < n_stages; ++j) {
    const auto at_j = legendre(c[j]);
    for (int k = 0; k < n_stages; ++k) e[j][k] = b[j] * (2 * k + 1) * at_j[k];
  }
  return e;
}
inline constexpr Matrix expansions = make_expansions();
}  // namespace detail

/// Returns ℓ_j(x) for all j.
constexpr OfStages lagrange(Real x) {
  const auto at_x = legendre(x);
  OfStages l{};
  for (int j = 0; j < n_stages; ++j)
    for (int k = 0; k < n_stages; ++k) l[j] += detail::expansions[j][k] * at_x[k];
  return l;
}

}  // namespace pseudorigid::mechanics::gauss
