#pragma once
/// Coefficients of explicit symmetric linear multistep methods with k steps of size h for q̈ = a (Lambert, Watson, J.
/// Inst. Maths Applics 18 (1976) 189; Quinlan, Tremaine, Astron. J. 100 (1990) 1694; Hairer, Lubich, Wanner, Geometric
/// Numerical Integration, XV.1),
///
///   Σ_j α_j q_{n+j} = h² Σ_j β_j a_{n+j},   ρ(ζ) = (ζ − 1)² ∏_i (ζ² − 2 a_i ζ + 1),   α_j = α_{k−j}, β_j = β_{k−j}.
///
/// The a_{n+j} in the sum are accelerations. The a_i in the product are k/2 − 1 parameters of the polynomial ρ(ζ) =
/// Σα_j ζ^j. All roots of ρ are on the unit circle, and all except the double root 1 are simple. The order conditions
/// determine the β_j. With indices counted from the middle, i = j − k/2, only the conditions for even s remain:
///
///   Σ_i α_i i^s = s(s − 1) Σ_i β_i i^{s−2},   s = 2, 4, …, k   (order k).
///
/// For systems with constraints, the roots of σ(ζ) = Σβ_j ζ^j other than 0 must also be simple and on the unit circle.
/// The reason is that the multipliers satisfy a recursion with the coefficients of σ (Console, Hairer, Lubich, Numer.
/// Math. 124 (2013) 517). The a_i of orders 8 and 12 result from a search among numbers with two decimals. With these
/// a_i, the roots of ρ are well separated, as are those of σ, and the error constant is small. The step is stable for
/// hω ≤ stability_limit. Order 4 has the parameter 0. The roots ±i of ρ are then midway between 1 and −1. At ±1 these
/// two roots would coincide.
///
/// Parasitic roots are the roots of ρ other than 1. A motion of frequency ω couples two parasitic roots e^{iθ}, e^{iθ'}
/// if hω is the difference of θ and θ'. This resonance is described by G. D. Quinlan (arXiv:astro-ph/9901136, 1999). At
/// such a step the error is larger than at slightly longer and shorter steps. For order 8 at hω = 0.305, the error is 7
/// times the error of a step that is longer by a tenth. `resonance_limit` is the smallest difference of θ and θ' for
/// two parasitic roots.

#include <array>

namespace pseudorigid::mechanics {

template <int k>
struct MultistepFormula {
  /// Coefficients of the differences d_n = q_n − q_{n−1} and of the accelerations a_n, the newest first:
  ///   d_{n+1} = Σ_i difference[i] d_{n−i} + h² Σ_i acceleration[i] a_{n−i},   i = 0 … k − 2.
  std::array<double, k - 1> difference{}, acceleration{};
  /// Coefficients of the last k accelerations in the formula for the velocity. The formula is exact if the motion is a
  /// polynomial in time of degree at most k + 1:
  ///   v_n = d_n/h + h Σ_i velocity[i] a_{n−i},   i = 0 … k − 1.
  std::array<double, k> velocity{};
};

namespace detail {

/// Returns the solution x of A x = b by elimination with row pivoting.
template <int n>
constexpr std::array<long double, n> solve(std::array<std::array<long double, n>, n> A, std::array<long double, n> b) {
  const auto size = [](long double x) { return x < 0 ? -x : x; };
  for (int c = 0; c < n; ++c) {
    int pivot = c;
    for (int r = c + 1; r < n; ++r)
      if (size(A[r][c]) > size(A[pivot][c])) pivot = r;
    const auto row = A[c];
    A[c] = A[pivot];
    A[pivot] = row;
    const long double value = b[c];
    b[c] = b[pivot];
    b[pivot] = value;
    for (int r = c + 1; r < n; ++r) {
      const long double factor = A[r][c] / A[c][c];
      for (int j = c; j < n; ++j) A[r][j] -= factor * A[c][j];
      b[r] -= factor * b[c];
    }
  }
  for (int c = n - 1; c >= 0; --c) {
    for (int j = c + 1; j < n; ++j) b[c] -= A[c][j] * b[j];
    b[c] /= A[c][c];
  }
  return b;
}

constexpr long double power(long double x, int n) { return n == 0 ? 1 : x * power(x, n - 1); }

/// Returns the k + 1 coefficients of ρ for the given parameters a_i, the lowest power first.
template <int k>
constexpr std::array<long double, k + 1> first_polynomial(const std::array<long double, k / 2 - 1>& a) {
  std::array<long double, k + 1> rho{1, -2, 1};
  for (int i = 0; i < k / 2 - 1; ++i)
    for (int j = 2 * i + 4; j >= 0; --j) rho[j] += (j >= 1 ? -2 * a[i] * rho[j - 1] : 0) + (j >= 2 ? rho[j - 2] : 0);
  return rho;
}

/// Returns the β_i with i = 0, …, k/2 − 1 counted from the middle, for given coefficients of ρ. For i = k/2, β_i = 0,
/// because the method is explicit.
template <int k>
constexpr std::array<long double, k / 2> second_polynomial(const std::array<long double, k + 1>& rho) {
  constexpr int m = k / 2;
  std::array<std::array<long double, m>, m> A{};
  std::array<long double, m> b{};
  for (int row = 0; row < m; ++row) {
    const int s = 2 * (row + 1);
    for (int j = 0; j <= k; ++j) b[row] += rho[j] * power(j - m, s);
    for (int i = 0; i < m; ++i) A[row][i] = s * (s - 1) * (i == 0 ? 1 : 2) * power(i, s - 2);
  }
  return solve<m>(A, b);
}

/// Returns the weights c_i of the accelerations a_{n−i} in the formula for the velocity. The c_i follow from the
/// condition that the formula is exact for a = (t − t_n)^s and h = 1:
///   Σ_i c_i (−i)^s = v_n − (q_n − q_{n−1}) = (−1)^s / ((s + 1)(s + 2)),   s = 0 … k − 1.
template <int k>
constexpr std::array<long double, k> velocity_weights() {
  std::array<std::array<long double, k>, k> A{};
  std::array<long double, k> b{};
  for (int s = 0; s < k; ++s) {
    for (int i = 0; i < k; ++i) A[s][i] = power(i, s);
    b[s] = 1.0L / ((s + 1) * (s + 2));
  }
  return solve<k>(A, b);
}

}  // namespace detail

/// Returns the formulas for the parameters a_i of ρ. The coefficients are computed in extended precision and then
/// rounded.
template <int k>
constexpr MultistepFormula<k> multistep_formula(const std::array<long double, k / 2 - 1>& a) {
  const auto rho = detail::first_polynomial<k>(a);
  const auto beta = detail::second_polynomial<k>(rho);
  const auto velocity = detail::velocity_weights<k>();
  MultistepFormula<k> formula;
  long double sum = rho[k];  // becomes each coefficient of ρ/(ζ − 1) in turn, the highest power first
  for (int i = 0; i < k - 1; ++i) {
    sum += rho[k - 1 - i];
    formula.difference[i] = static_cast<double>(-sum);
    const int from_middle = k / 2 - 1 - i;
    formula.acceleration[i] = static_cast<double>(beta[from_middle < 0 ? -from_middle : from_middle]);
  }
  for (int i = 0; i < k; ++i) formula.velocity[i] = static_cast<double>(velocity[i]);
  return formula;
}

struct Symmetric4Coefficients {
  static constexpr int order = 4;
  static constexpr double stability_limit = 1.73, resonance_limit = 3.14;
  static constexpr std::array<long double, 1> a{0.0L};
};
struct Symmetric8Coefficients {
  static constexpr int order = 8;
  static constexpr double stability_limit = 0.44, resonance_limit = 0.305;
  static constexpr std::array<long double, 3> a{-0.94L, 0.32L, 0.59L};
};
struct Symmetric12Coefficients {
  static constexpr int order = 12;
  static constexpr double stability_limit = 0.34, resonance_limit = 0.204;
  static constexpr std::array<long double, 5> a{-0.96L, 0.42L, 0.60L, 0.75L, 0.88L};
};

}  // namespace pseudorigid::mechanics
