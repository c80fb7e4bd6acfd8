#pragma once
/// Exact frequencies of the incompressible elastic sphere (Lamb 1882), x = ωr/c, N = n(n+1), j_n spherical Bessel:
///
///   spheroidal  [2n(n−1) − x²][(2N − 2 − x²) j_n − 2x j_n'] − 4N(n−1)[x j_n' − j_n] = 0
///   toroidal    x j_n' − j_n = 0,        j_n' = j_{n−1} − (n+1)/x j_n

#include <cmath>

namespace pseudorigid::continuum {

inline double sphere_equation(bool spheroidal, int n, double x) {
  const double j = std::sph_bessel(static_cast<unsigned>(n), x);
  const double dj = std::sph_bessel(static_cast<unsigned>(n - 1), x) - (n + 1) / x * j;
  const double N = n * (n + 1), toroidal = x * dj - j;
  if (!spheroidal) return toroidal;
  return (2 * n * (n - 1) - x * x) * ((2 * N - 2 - x * x) * j - 2 * x * dj) - 4 * N * (n - 1) * toroidal;
}

/// x of degree n ≥ 1; overtone 0 is the lowest positive root.
inline double sphere_frequency(bool spheroidal, int n, int overtone) {
  constexpr double first = 0.5, step = 0.05;  // no root lies below, and no two are so close
  double low = first, value = sphere_equation(spheroidal, n, low);
  for (int remaining = overtone;; low += step) {
    const double next = sphere_equation(spheroidal, n, low + step);
    if ((value > 0) != (next > 0) && remaining-- == 0) break;
    value = next;
  }
  double high = low + step;
  for (double middle = 0.5 * (low + high); low < middle && middle < high; middle = 0.5 * (low + high))
    ((sphere_equation(spheroidal, n, middle) > 0) == (value > 0) ? low : high) = middle;
  return 0.5 * (low + high);
}

}  // namespace pseudorigid::continuum
