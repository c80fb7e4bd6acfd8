#pragma once
/// Spheroidal modes n = 2 of the incompressible elastic sphere (Lamb 1882; PHYSICS 3), x = ωr/c, N = n(n+1) = 6:
///
///   (4 − x²)[(10 − x²)j₂ − 2x j₂'] − 24 [x j₂' − j₂] = 0
///   U = N j₂(xt)/t + 2bt,   V = j₂(xt)/t + x j₂'(xt) + bt,   u = U P₂ e_r + V ∂_θP₂ e_θ at radius t,
///
/// b from the vanishing tangential traction V' − V + U = 0 at t = 1: b = −½[(10 − x²)j₂ − 2x j₂'].
/// The affine field HX, H = diag(1,1,−2), is U = 2t, V = t up to sign, of square norm ∫(U² + N V²)t² dt = 2. Its
/// fraction in mode k is f_k = ⟨affine, mode⟩² / (2 ⟨mode, mode⟩).

#include <deal.II/base/quadrature_lib.h>

#include <cmath>
#include <vector>

namespace pseudorigid::testing {

struct LambMode {
  double x, fraction;
};

inline double bessel_2(double z) { return std::sph_bessel(2, z); }
inline double bessel_2_derivative(double z) { return std::sph_bessel(1, z) - 3 / z * std::sph_bessel(2, z); }

inline double lamb_equation(double x) {
  const double j = bessel_2(x), dj = bessel_2_derivative(x);
  return (4 - x * x) * ((10 - x * x) * j - 2 * x * dj) - 24 * (x * dj - j);
}

inline double lamb_root(double low, double high) {
  const bool rises = lamb_equation(high) > 0;
  while (high - low > 4e-16 * high) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    ((lamb_equation(middle) > 0) == rises ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

inline double affine_fraction(double x) {
  const double b = -0.5 * ((10 - x * x) * bessel_2(x) - 2 * x * bessel_2_derivative(x));
  double overlap = 0, norm = 0;
  const dealii::QGauss<1> rule(200);
  for (unsigned int q = 0; q < rule.size(); ++q) {
    const double t = rule.point(q)[0], weight = rule.weight(q) * t * t, j = bessel_2(x * t) / t;
    const double U = 6 * j + 2 * b * t, V = j + x * bessel_2_derivative(x * t) + b * t;
    overlap += weight * (2 * t * U + 6 * t * V);
    norm += weight * (U * U + 6 * V * V);
  }
  return overlap * overlap / (2 * norm);
}

/// The lowest n modes.
inline std::vector<LambMode> lamb_modes(std::size_t n) {
  std::vector<LambMode> modes;
  constexpr double step = 0.05;
  for (double x = 1; modes.size() < n; x += step)
    if ((lamb_equation(x) > 0) != (lamb_equation(x + step) > 0)) {
      const double root = lamb_root(x, x + step);
      modes.push_back({root, affine_fraction(root)});
    }
  return modes;
}

/// Q_M − Id of the release ẋ(0) = εHX, per εH: Σ f_k sin(x_k τ)/x_k.
inline double lamb_response(const std::vector<LambMode>& modes, double t) {
  double sum = 0;
  for (const LambMode& mode : modes) sum += mode.fraction * std::sin(mode.x * t) / mode.x;
  return sum;
}

}  // namespace pseudorigid::testing
