#include "polynomial/octant_quadrature.h"

#include <cmath>
#include <numbers>

namespace pseudorigid::polynomial {
namespace {

/// The value of Legendre's polynomial P_n(x) and its derivative.
struct LegendreValue {
  double value, derivative;
};
LegendreValue legendre(int n, double x) {
  double before = 1, value = x;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
    before = value;
    value = next;
  }
  return {value, n * (before - x * value) / ((1 - x) * (1 + x))};
}

}  // namespace

HalfGaussRule half_gauss_rule(int q) {
  const int n = 2 * q;
  HalfGaussRule rule;
  for (int i = q; i >= 1; --i) {
    double x = std::cos(std::numbers::pi * (i - 0.25) / (n + 0.5));
    constexpr int n_newton = 8;  // from this initial value, four steps reach round-off at any n
    for (int k = 0; k < n_newton; ++k) {
      const auto [P, dP] = legendre(n, x);
      x -= P / dP;
    }
    const double dP = legendre(n, x).derivative;
    rule.nodes.push_back(x);
    rule.weights.push_back(2 / ((1 - x) * (1 + x) * dP * dP));
  }
  return rule;
}

std::vector<SurfacePoint> octant_surface_points(int q) {
  const auto [nodes, weights] = half_gauss_rule(q);
  const double arc = std::numbers::pi / (2 * q);
  std::vector<SurfacePoint> points;
  for (int j = 0; j < q; ++j)
    for (int k = 0; k < q; ++k) {
      const double z = nodes[j], rho = std::sqrt((1 - z) * (1 + z)), phi = (k + 0.5) * arc;
      const double c = std::cos(phi), s = std::sin(phi);
      points.push_back({{rho * c, rho * s, z}, {z * c, z * s, -rho}, {-s, c, 0}, weights[j] * arc});
    }
  return points;
}

std::vector<WeightedPoint> octant_points(int q) {
  const auto [radii, weights] = half_gauss_rule(q);
  std::vector<WeightedPoint> points;
  for (int i = 0; i < q; ++i)
    for (const SurfacePoint& direction : octant_surface_points(q)) {
      const auto& [x, y, z] = direction.xi;
      const double r = radii[i];
      points.push_back({{r * x, r * y, r * z}, direction.weight * weights[i] * r * r});
    }
  return points;
}

}  // namespace pseudorigid::polynomial
