#pragma once
/// Exact angular frequencies ω of the elastic sphere (Lamb 1882; Eringen and Şuhubi, Elastodynamics II, 8.14). The
/// unknown is x = ωr/c, with the radius r and the speed c of shear waves. With the speed c_p of pressure waves,
/// y = ωr/c_p = x c/c_p. For the degree n, N = n(n+1). The spherical Bessel functions j_n and their derivatives j_n'
/// have the argument x if none is written. The equations are
///
///   toroidal                   x j_n' − j_n = 0,        j_n' = j_{n−1} − (n+1)/x j_n
///   spheroidal, incompressible [2n(n−1) − x² + γ n k_n][(2N − 2 − x²) j_n − 2x j_n']
///                              − 2N(n−1)[2(x j_n' − j_n) + γ k_n j_n] = 0,      k_n = 2(n−1)/(2n+1),
///       γ = ρgr/μ and g = (4/3)πGρr with self-gravity (density ρ, shear modulus μ), otherwise γ = 0
///   spheroidal, compressible   T₁₁T₄₃ − T₁₃T₄₁ = 0,
///       T₁₁ = [n(n−1) − x²/2] j_n(y) + 2y j_{n+1}(y),   T₁₃ = N[(n−1) j_n(x) − x j_{n+1}(x)],
///       T₄₁ = (n−1) j_n(y) − y j_{n+1}(y),              T₄₃ = [n² − 1 − x²/2] j_n(x) + x j_{n+1}(x)
///   radial (n = 0)             T₁₁ = 0,  that is  y cot y = 1 − (y²/4)(c_p/c)²

#include <cmath>

namespace pseudorigid::analysis {

/// The left-hand side of the equation for toroidal modes, n ≥ 1.
inline double toroidal_equation(int n, double x) {
  const double j = std::sph_bessel(static_cast<unsigned>(n), x);
  return x * std::sph_bessel(static_cast<unsigned>(n - 1), x) - (n + 2) * j;
}

/// The left-hand side of the equation for incompressible spheroidal modes, n ≥ 1. `gamma` is γ.
inline double incompressible_spheroidal_equation(int n, double x, double gamma) {
  const double j = std::sph_bessel(static_cast<unsigned>(n), x);
  const double dj = std::sph_bessel(static_cast<unsigned>(n - 1), x) - (n + 1) / x * j;
  const double N = n * (n + 1);
  const double pull = gamma * 2 * (n - 1) / (2 * n + 1);
  return (2 * n * (n - 1) - x * x + n * pull) * ((2 * N - 2 - x * x) * j - 2 * x * dj) -
         2 * N * (n - 1) * (2 * toroidal_equation(n, x) + pull * j);
}

/// The left-hand side of the equation for compressible spheroidal modes, n ≥ 0. For n = 0 the equation is that of the
/// radial modes. The argument `ratio` is c/c_p.
inline double compressible_spheroidal_equation(int n, double x, double ratio) {
  const double y = ratio * x, N = n * (n + 1);
  const auto j = [](int degree, double z) { return std::sph_bessel(static_cast<unsigned>(degree), z); };
  const double T11 = (n * (n - 1) - x * x / 2) * j(n, y) + 2 * y * j(n + 1, y);
  if (n == 0) return T11;
  const double T13 = N * ((n - 1) * j(n, x) - x * j(n + 1, x)), T41 = (n - 1) * j(n, y) - y * j(n + 1, y);
  const double T43 = (n * n - 1 - x * x / 2) * j(n, x) + x * j(n + 1, x);
  return T11 * T43 - T13 * T41;
}

/// The root of f above 0.5 with the number `overtone`, counted from 0 for the lowest root. All frequencies of the
/// sphere satisfy x > 0.5 if Lamé's modulus λ is not negative. The function does not return if there is no such root.
template <class Function>
double sphere_root(const Function& f, int overtone) {
  constexpr double first = 0.5, step = 0.01;  // the distance of two roots of one degree is larger than this step
  double low = first, value = f(low);
  for (int remaining = overtone;; low += step) {
    const double next = f(low + step);
    if ((value > 0) != (next > 0) && remaining-- == 0) break;
    value = next;
  }
  double high = low + step;
  for (double middle = 0.5 * (low + high); low < middle && middle < high; middle = 0.5 * (low + high))
    ((f(middle) > 0) == (value > 0) ? low : high) = middle;
  return 0.5 * (low + high);
}

/// The frequency x = ωr/c of the incompressible sphere for degree n ≥ 1. `gamma` is γ, or 0 without self-gravity.
/// Toroidal modes do not depend on γ.
inline double sphere_frequency(bool spheroidal, int n, int overtone, double gamma = 0) {
  return sphere_root(
      [=](double x) { return spheroidal ? incompressible_spheroidal_equation(n, x, gamma) : toroidal_equation(n, x); },
      overtone);
}
/// The frequency x = ωr/c of the compressible sphere. `ratio` is c/c_p. The degree is n ≥ 0 for spheroidal and n ≥ 1
/// for toroidal modes.
inline double compressible_sphere_frequency(bool spheroidal, int n, int overtone, double ratio) {
  if (!spheroidal) return sphere_frequency(false, n, overtone);
  return sphere_root([=](double x) { return compressible_spheroidal_equation(n, x, ratio); }, overtone);
}

}  // namespace pseudorigid::analysis
