#include "polynomial/ball_polynomials.h"

#include <cmath>
#include <cstddef>

namespace pseudorigid::polynomial {
namespace {

using mechanics::constant;

/// Jacobi's polynomials P_s^{(0,b)}(t) for s = 0 … n. Their gradients are with respect to the coordinates of the
/// gradient of t.
std::vector<Jet> jacobi_polynomials(int n, double b, const Jet& t) {
  std::vector<Jet> P{constant(1)};
  if (n > 0) P.push_back(0.5 * ((b + 2) * t + constant(-b)));
  for (int s = 2; s <= n; ++s) {
    const double c = 2 * s + b, scale = 2 * s * (s + b) * (c - 2);
    P.push_back((1 / scale) * (((c - 1) * (c * (c - 2) * t + constant(-b * b))) * P[s - 1] +
                               (-2 * (s - 1) * (s + b - 1) * c) * P[s - 2]));
  }
  return P;
}

}  // namespace

std::vector<BallPolynomial> ball_polynomials(int N) {
  std::vector<BallPolynomial> functions;
  for (int n = 0; n <= N; ++n)
    for (int l = n; l >= 0; l -= 2)
      for (int m = -l; m <= l; ++m) functions.push_back({n, l, m});
  return functions;
}

Jet radial_factor(int n, int l, double r) {
  const Jet radius{r, {1, 0, 0}};
  Jet value =
      std::sqrt(2.0 * n + 3) * jacobi_polynomials((n - l) / 2, l + 0.5, 2 * radius * radius + constant(-1)).back();
  for (int k = 0; k < l; ++k) value = value * radius;
  return value;
}

std::vector<Jet> evaluate_ball_polynomials(int N, const std::array<double, 3>& xi) {
  const auto solid = solid_harmonics(N, xi);
  const Jet r2{xi[0] * xi[0] + xi[1] * xi[1] + xi[2] * xi[2], {2 * xi[0], 2 * xi[1], 2 * xi[2]}};
  std::vector<std::vector<Jet>> radial;  // [l][s]: the polynomial P_s for this l
  for (int l = 0; l <= N; ++l) radial.push_back(jacobi_polynomials((N - l) / 2, l + 0.5, 2 * r2 + constant(-1)));

  std::vector<Jet> values;
  for (const auto& [n, l, m] : ball_polynomials(N))
    values.push_back(std::sqrt(2.0 * n + 3) * radial[l][(n - l) / 2] * solid[l][l + m]);
  return values;
}

}  // namespace pseudorigid::polynomial
