#include "mechanics/core/kepler.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace pseudorigid::mechanics {
namespace {

/// Returns the solution of f(x) = mean for an increasing f, by Newton's method from the guess x. If an iterate leaves
/// the bracket [low, high], the middle of the bracket replaces it. `of(x)` returns the pair of f(x) and f′(x). Returns
/// the last iterate if 200 steps are not enough.
template <class Function>
double increasing_root(double mean, double low, double high, double x, const Function& of) {
  constexpr int most_steps = 200;
  for (int n = 0; n < most_steps; ++n) {
    const auto [value, slope] = of(x);
    (value > mean ? high : low) = x;
    double next = x - (value - mean) / slope;
    if (!(next > low && next < high)) next = low + (high - low) / 2;
    if (next == x || next <= low || next >= high) return x;
    x = next;
  }
  return x;
}

}  // namespace

double eccentric_anomaly(double mean, double e) {
  const double turns = std::round(mean / (2 * std::numbers::pi)) * (2 * std::numbers::pi), rest = mean - turns;
  return turns + increasing_root(rest, rest - e, rest + e, rest + e * std::sin(rest),
                                 [e](double E) { return std::pair(E - e * std::sin(E), 1 - e * std::cos(E)); });
}

double hyperbolic_anomaly(double mean, double e) {
  // |H| is at most `bound`, because (e − 1) sinh H ≤ e sinh H − H for H ≥ 0.
  const double bound = std::asinh(std::abs(mean) / (e - 1));
  return increasing_root(mean, -bound, bound, std::copysign(std::asinh(std::abs(mean) / e), mean),
                         [e](double H) { return std::pair(e * std::sinh(H) - H, e * std::cosh(H) - 1); });
}

OrbitalMotion motion_of(const KeplerElements& o, double g) {
  const double e = o.eccentricity, size = std::abs(o.semi_major_axis), rate = std::sqrt(g / size) / size;
  const double minor = std::sqrt(std::abs((1 - e) * (1 + e)));
  Eigen::Vector2d r, v;  // components towards the pericentre, and along the velocity at the pericentre
  if (o.semi_major_axis > 0) {
    const double E = eccentric_anomaly(o.mean_anomaly, e), c = std::cos(E), s = std::sin(E);
    r = size * Eigen::Vector2d(c - e, minor * s);
    v = size * rate / (1 - e * c) * Eigen::Vector2d(-s, minor * c);
  } else {
    const double H = hyperbolic_anomaly(o.mean_anomaly, e), c = std::cosh(H), s = std::sinh(H);
    r = size * Eigen::Vector2d(e - c, minor * s);
    v = size * rate / (e * c - 1) * Eigen::Vector2d(-s, minor * c);
  }
  const double ci = std::cos(o.inclination), si = std::sin(o.inclination), cn = std::cos(o.ascending_node),
               sn = std::sin(o.ascending_node), cp = std::cos(o.argument_of_pericentre),
               sp = std::sin(o.argument_of_pericentre);
  const Eigen::Vector3d to_pericentre(cn * cp - sn * ci * sp, sn * cp + cn * ci * sp, si * sp),
      ahead(-cn * sp - sn * ci * cp, -sn * sp + cn * ci * cp, si * cp);
  return {r[0] * to_pericentre + r[1] * ahead, v[0] * to_pericentre + v[1] * ahead};
}

KeplerElements elements_of(const Eigen::Vector3d& r, const Eigen::Vector3d& v, double g) {
  const double d = r.norm(), by_a = 2 / d - v.squaredNorm() / g;
  const Eigen::Vector3d h = r.cross(v), eccentric = v.cross(h) / g - r / d;
  KeplerElements o;
  o.semi_major_axis = by_a == 0 ? 0 : 1 / by_a;
  o.eccentricity = eccentric.norm();
  o.inclination = std::atan2(std::hypot(h[0], h[1]), h[2]);
  // An orbit in the plane z = 0 has no node. Without this bound, round-off would determine the direction of the node.
  constexpr double least_inclination = 1e-10;
  const bool has_node = std::hypot(h[0], h[1]) > least_inclination * h.norm();
  const Eigen::Vector3d node = has_node ? Eigen::Vector3d(-h[1], h[0], 0).normalized() : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d normal = h.isZero(0) ? Eigen::Vector3d::UnitZ() : h.normalized(), across = normal.cross(node);
  o.ascending_node = std::atan2(node[1], node[0]);
  if (o.eccentricity > 0) o.argument_of_pericentre = std::atan2(eccentric.dot(across), eccentric.dot(node));
  const double true_anomaly =
      std::remainder(std::atan2(r.dot(across), r.dot(node)) - o.argument_of_pericentre, 2 * std::numbers::pi);
  const double e = o.eccentricity;
  if (by_a > 0) {
    const double E = 2 * std::atan2(std::sqrt(std::max(0.0, 1 - e)) * std::sin(true_anomaly / 2),
                                    std::sqrt(1 + e) * std::cos(true_anomaly / 2));
    o.mean_anomaly = E - e * std::sin(E);
  } else if (by_a < 0) {
    const double sinh_H = r.dot(v) * std::sqrt(-by_a / g) / e;
    o.mean_anomaly = e * sinh_H - std::asinh(sinh_H);
  }
  return o;
}

}  // namespace pseudorigid::mechanics
