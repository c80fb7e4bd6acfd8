#include "polynomial/ball_polynomials.h"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace pseudorigid::polynomial {
namespace {

Jet operator+(const Jet& a, const Jet& b) {
  Jet sum{a.value + b.value, {}};
  for (int i = 0; i < 3; ++i) sum.gradient[i] = a.gradient[i] + b.gradient[i];
  return sum;
}
Jet operator*(const Jet& a, const Jet& b) {
  Jet product{a.value * b.value, {}};
  for (int i = 0; i < 3; ++i) product.gradient[i] = a.gradient[i] * b.value + a.value * b.gradient[i];
  return product;
}
Jet operator*(double s, const Jet& a) { return Jet{s, {}} * a; }
Jet constant(double value) { return {value, {}}; }

/// Jacobi's polynomials P_s^{(0,b)} at t for s = 0 … n.
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

/// The common factor of Re (x + iy)^|m| and Im (x + iy)^|m| in |ξ|^l Y_lm, at [l][|m|].
std::vector<std::vector<Jet>> polar_factors(int N, const Jet& z, const Jet& r2) {
  std::vector<std::vector<Jet>> factor(N + 1, std::vector<Jet>(N + 1));
  factor[0][0] = constant(std::sqrt(1 / (4 * std::numbers::pi)));
  for (int m = 1; m <= N; ++m) {
    const double of_two_functions = m == 1 ? std::numbers::sqrt2 : 1.0;
    factor[m][m] = of_two_functions * std::sqrt((2.0 * m + 1) / (2.0 * m)) * factor[m - 1][m - 1];
  }
  for (int m = 0; m <= N; ++m)
    for (int l = m + 1; l <= N; ++l) {
      const double a = std::sqrt((4.0 * l * l - 1) / (l * l - m * m));
      factor[l][m] = a * z * factor[l - 1][m];
      if (l - 1 == m) continue;
      const double b = std::sqrt(((l - 1.0) * (l - 1) - m * m) / (4.0 * (l - 1) * (l - 1) - 1));
      factor[l][m] = factor[l][m] + (-a * b) * r2 * factor[l - 2][m];
    }
  return factor;
}

struct Variables {
  Jet x, y, z, r2;
};
Variables variables(const std::array<double, 3>& xi) {
  const Jet x{xi[0], {1, 0, 0}}, y{xi[1], {0, 1, 0}}, z{xi[2], {0, 0, 1}};
  return {x, y, z, x * x + y * y + z * z};
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

std::vector<std::vector<Jet>> solid_harmonics(int N, const std::array<double, 3>& xi) {
  const auto& [x, y, z, r2] = variables(xi);
  std::vector<Jet> real{constant(1)}, imaginary{constant(0)};  // real and imaginary parts of (x + iy)^m
  for (int m = 1; m <= N; ++m) {
    real.push_back(x * real[m - 1] + (-1.0) * y * imaginary[m - 1]);
    imaginary.push_back(x * imaginary[m - 1] + y * real[m - 1]);
  }
  const auto factor = polar_factors(N, z, r2);
  std::vector<std::vector<Jet>> solid(N + 1);
  for (int l = 0; l <= N; ++l)
    for (int m = -l; m <= l; ++m) solid[l].push_back(factor[l][std::abs(m)] * (m < 0 ? imaginary[-m] : real[m]));
  return solid;
}

std::vector<Jet> evaluate_ball_polynomials(int N, const std::array<double, 3>& xi) {
  const auto solid = solid_harmonics(N, xi);
  std::vector<std::vector<Jet>> radial;  // P_s for each l, at [l][s]
  for (int l = 0; l <= N; ++l)
    radial.push_back(jacobi_polynomials((N - l) / 2, l + 0.5, 2 * variables(xi).r2 + constant(-1)));

  std::vector<Jet> values;
  for (const auto& [n, l, m] : ball_polynomials(N))
    values.push_back(std::sqrt(2.0 * n + 3) * radial[l][(n - l) / 2] * solid[l][l + m]);
  return values;
}

}  // namespace pseudorigid::polynomial
