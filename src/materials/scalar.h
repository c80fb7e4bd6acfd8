#pragma once
/// Functions of scalars that laws use, for the scalars that the standard library leaves out; SIMD types bring their
/// own.

#include <cmath>
#include <complex>

namespace pseudorigid::materials {

inline double log1p(double x) { return std::log1p(x); }
inline std::complex<double> log1p(std::complex<double> z) { return std::log(1.0 + z); }

namespace detail {
/// x − ln(1+x) = s [x − 2s²(1/3 + s²/5 + s⁴/7 + …)],  s = x/(2+x),  since ln(1+x) = 2 artanh s. To round-off for |x| ≤
/// ¼.
template <class T>
T x_minus_log1p_series(const T& x) {
  const T s = x / (2.0 + x), s2 = s * s;
  T sum = T(1.0 / 23);
  for (int n = 21; n >= 3; n -= 2) sum = sum * s2 + 1.0 / n;
  return s * (x - 2.0 * s2 * sum);
}
}  // namespace detail

/// x − ln(1+x) ≈ x²/2 without cancellation at small x. SIMD types that bring none get the plain difference, which is
/// right to |x| ε absolutely.
template <class T>
T x_minus_log1p(const T& x) {
  return x - log1p(x);
}
inline double x_minus_log1p(double x) { return std::abs(x) <= 0.25 ? detail::x_minus_log1p_series(x) : x - log1p(x); }
inline std::complex<double> x_minus_log1p(std::complex<double> z) {
  return std::abs(z) <= 0.25 ? detail::x_minus_log1p_series(z) : z - log1p(z);
}

/// J, and exactly 1 if J is 1 to its round-off. A factor 1 ± ε moves a number of mantissa m ∈ [1, 2) by m or m/2
/// units of its last place, which is rounded to a whole number of them: an error decided by the leading digits, not by
/// the last ones. It gives the entries of a tensor without torque one that does not average out over a motion, on SL(3)
/// 6e-13 of J and Z in 10⁶ periods.
inline double settled_at_one(double J) { return std::abs(J - 1) <= 0x1p-48 ? 1.0 : J; }
/// Other scalars, such as those of derivatives by complex step and SIMD lanes, are returned unchanged, because a jump
/// would spoil them.
template <class T>
[[gnu::always_inline]] inline const T& settled_at_one(const T& J) {
  return J;
}

/// ln J, and cheap if J is about 1, as in the iterations of the constraint det Q = 1: with δ = J − 1 (exact),
/// ln J = δ − δ²/2 + δ³/3 − δ⁴/4 + δ⁵/5, whose remainder δ⁶/6 is below round-off of the sum for |δ| ≤ 2⁻¹¹.
/// If J has extended precision, small logarithms have as many digits as δ.
template <class T>
double log_near_one(T J) {
  const double delta = static_cast<double>(J - 1);
  if (!(std::abs(delta) <= 0x1p-11)) return std::log(static_cast<double>(J));
  return delta - delta * delta * (1.0 / 2 - delta * (1.0 / 3 - delta * (1.0 / 4 - delta * (1.0 / 5))));
}

}  // namespace pseudorigid::materials
