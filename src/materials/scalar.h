#pragma once
/// Functions of scalars for the material laws. They are for double and complex; SIMD types have their own functions.

#include <cmath>
#include <complex>

namespace pseudorigid::materials {

inline double log1p(double x) { return std::log1p(x); }
inline std::complex<double> log1p(std::complex<double> z) { return std::log(1.0 + z); }

namespace detail {
/// x − ln(1+x) = s [x − 2s²(1/3 + s²/5 + s⁴/7 + …)] with s = x/(2+x), since ln(1+x) = 2 artanh s. The result is exact
/// to round-off for |x| ≤ ¼.
template <class T>
T x_minus_log1p_series(const T& x) {
  const T s = x / (2.0 + x), s2 = s * s;
  T sum = T(1.0 / 23);
  for (int n = 21; n >= 3; n -= 2) sum = sum * s2 + 1.0 / n;
  return s * (x - 2.0 * s2 * sum);
}
}  // namespace detail

/// x − ln(1+x) ≈ x²/2, without cancellation for small x. For a SIMD type without its own function, the result is the
/// direct difference of both terms, with the absolute error |x| ε.
template <class T>
T x_minus_log1p(const T& x) {
  return x - log1p(x);
}
inline double x_minus_log1p(double x) { return std::abs(x) <= 0.25 ? detail::x_minus_log1p_series(x) : x - log1p(x); }
inline std::complex<double> x_minus_log1p(std::complex<double> z) {
  return std::abs(z) <= 0.25 ? detail::x_minus_log1p_series(z) : z - log1p(z);
}

/// Returns J, or exactly 1 if J differs from 1 only by round-off. A factor 1 ± ε would change a number with mantissa m
/// ∈ [1, 2) by m or m/2 units of its last place, rounded to a whole number of units. This rounding depends on the
/// leading digits, so it does not average out over a motion. As a result a symmetric stress would exert a torque.
/// Without this function, angular momentum and circulation on SL(3) drift by 6e-13 in 10⁶ periods.
inline double settled_at_one(double J) { return std::abs(J - 1) <= 0x1p-48 ? 1.0 : J; }
/// Returns other scalars unchanged, such as complex numbers and SIMD lanes. For derivatives by complex step, a jump
/// would make the derivatives wrong.
template <class T>
[[gnu::always_inline]] inline const T& settled_at_one(const T& J) {
  return J;
}

/// ln J, computed fast for J near 1, as the iterations of the constraint det Q = 1 need it. With the exact δ = J − 1,
/// the sum is δ − δ²/2 + δ³/3 − δ⁴/4 + δ⁵/5. The remainder δ⁶/6 is below the round-off of the sum for |δ| ≤ 2⁻¹¹. If J
/// has extended precision, a small logarithm is as accurate as δ.
template <class T>
double log_near_one(T J) {
  const double delta = static_cast<double>(J - 1);
  if (!(std::abs(delta) <= 0x1p-11)) return std::log(static_cast<double>(J));
  return delta - delta * delta * (1.0 / 2 - delta * (1.0 / 3 - delta * (1.0 / 4 - delta * (1.0 / 5))));
}

}  // namespace pseudorigid::materials
