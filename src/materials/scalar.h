#pragma once
/// Functions of scalars for the material laws: for real and complex numbers, and as templates for SIMD vectors. The
/// function log1p of SIMD vectors is in mechanics/core/lanes.h.

#include <cmath>
#include <complex>

namespace pseudorigid::materials {

inline double log1p(double x) { return std::log1p(x); }
inline std::complex<double> log1p(std::complex<double> z) { return std::log(1.0 + z); }

namespace detail {
/// Returns x − ln(1+x) = s [x − 2s²(1/3 + s²/5 + s⁴/7 + …)] with s = x/(2+x). The series follows from ln(1+x) = 2
/// artanh s. For |x| ≤ ¼, the terms that are left out are below round-off.
template <class T>
T x_minus_log1p_series(const T& x) {
  const T s = x / (2.0 + x), s2 = s * s;
  T sum = T(1.0 / 23);
  for (int n = 21; n >= 3; n -= 2) sum = sum * s2 + 1.0 / n;
  return s * (x - 2.0 * s2 * sum);
}
}  // namespace detail

/// Returns x − ln(1+x), about x²/2 for small x. For real and complex x, there is no cancellation for small x. For SIMD
/// vectors, the result is computed as the difference of the two terms, and its absolute error is about |x| ε with ε =
/// 2⁻⁵².
template <class T>
T x_minus_log1p(const T& x) {
  return x - log1p(x);
}
inline double x_minus_log1p(double x) { return std::abs(x) <= 0.25 ? detail::x_minus_log1p_series(x) : x - log1p(x); }
inline std::complex<double> x_minus_log1p(std::complex<double> z) {
  return std::abs(z) <= 0.25 ? detail::x_minus_log1p_series(z) : z - log1p(z);
}

/// Returns J, or exactly 1 if J differs from 1 only by round-off, at most 16 ε with ε = 2⁻⁵². A factor 1 ± ε would
/// change a number with mantissa m ∈ [1, 2) by m or m/2 units of its last place. This change is rounded to a whole
/// number of units. The rounding depends on the leading digits, so it does not average out over a motion. As a result a
/// symmetric stress would exert a torque. Without this function, the angular momentum and the circulation of an
/// incompressible body drift by 6e-13 in 10⁶ periods.
inline double settled_at_one(double J) { return std::abs(J - 1) <= 0x1p-48 ? 1.0 : J; }
/// For other scalars, such as complex numbers and SIMD lanes, the function returns J unchanged. A jump to 1 would make
/// derivatives by complex step wrong.
template <class T>
[[gnu::always_inline]] inline const T& settled_at_one(const T& J) {
  return J;
}

/// Returns ln J. The function is fast for J near 1, as in the iterations for the constraint det Q = 1. T is double or
/// an extended precision. For |δ| ≤ 2⁻¹¹ with the exact δ = J − 1, the result is δ − δ²/2 + δ³/3 − δ⁴/4 + δ⁵/5. The
/// remainder δ⁶/6 is then below the round-off of the sum. For other J, the result is std::log. If J has extended
/// precision, a small logarithm is as accurate as δ.
template <class T>
double log_near_one(T J) {
  const double delta = static_cast<double>(J - 1);
  if (!(std::abs(delta) <= 0x1p-11)) return std::log(static_cast<double>(J));
  return delta - delta * delta * (1.0 / 2 - delta * (1.0 / 3 - delta * (1.0 / 4 - delta * (1.0 / 5))));
}

}  // namespace pseudorigid::materials
