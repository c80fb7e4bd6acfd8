#pragma once
/// Surfaces with their metrics in closed form, for the geodesic flow (Oliva, Geometric Mechanics, 5.3 with F = 0). A
/// surface in ℝ³ also has an embedding x(q), and its metric is the induced metric g = DxᵀDx.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "mechanics/core/automatic_differentiation.h"
#include "systems/systems_in_lanes.h"

namespace pseudorigid::systems {

template <class T>
using SurfacePoint = mechanics::Coordinates<T, 2>;
template <class T>
using SurfaceMetric = Eigen::Matrix<T, 2, 2>;
template <class T>
using SpacePoint = Eigen::Matrix<T, 3, 1>;

/// Returns a positive number if the angle θ from the axis is between √ε and π − √ε, with the machine precision ε and √ε
/// = 2⁻²⁶. Otherwise the result is not positive.
template <class T>
T between_poles(const T& theta) {
  using std::min;
  constexpr double margin = 0x1p-26;
  return min(T(theta - margin), T(std::numbers::pi - margin - theta));
}

/// The sphere x = R (sin θ cos φ, sin θ sin φ, cos θ) with the coordinates q = (θ, φ) and ds² = R² (dθ² + sin²θ dφ²).
/// The chart is singular at the poles.
struct Sphere {
  static constexpr int dimension = 2;
  double R = 1;

  template <class T>
  SurfaceMetric<T> metric(const SurfacePoint<T>& q) const {
    using std::sin;
    const T s = sin(q[0]);
    SurfaceMetric<T> g;
    g << T(R * R), T(0.0), T(0.0), T(R * R * s * s);
    return g;
  }
  template <class T>
  SpacePoint<T> embedding(const SurfacePoint<T>& q) const {
    using std::cos, std::sin;
    return {R * sin(q[0]) * cos(q[1]), R * sin(q[0]) * sin(q[1]), R * cos(q[0])};
  }
  /// Returns a positive number inside the chart, and otherwise a number that is not positive. The chart ends at the
  /// angle √ε from a pole, with the machine precision ε. Closer to a pole, sin²θ is less than ε.
  template <class T>
  T reserve(const SurfacePoint<T>& q) const {
    return between_poles(q[0]);
  }
  Eigen::Vector2d periods() const { return {0, 2 * std::numbers::pi}; }
};

/// The torus of revolution about the x axis (5.8.8) with the coordinates (w, u). Its points are x = (r sin w, ρ sin u,
/// ρ cos u) with ρ = R + r cos w. Its metric is ds² = r² dw² + ρ² du².
///
/// The circles w = 0 (outside) and w = π (inside) are invariant under a reflection. A motion that starts along such a
/// circle remains on the circle by symmetry. In floating-point arithmetic, this motion remains on the circle if the
/// coordinate of the circle is 0. If the coordinate is π, the motion leaves the circle, because the sine of the double
/// nearest to π is not 0. Therefore the first coordinate of this chart is w − w₀ with w₀ = kπ, k an integer
/// (TorusCircle).
struct TorusSurface {
  static constexpr int dimension = 2;
  double R = 3, r = 1;
  double outward = 1;  // cos w₀: 1 if the angle is measured from the outside, −1 from the inside

  template <class T>
  SurfaceMetric<T> metric(const SurfacePoint<T>& q) const {
    using std::cos;
    const T rho = R + outward * r * cos(q[0]);
    SurfaceMetric<T> g;
    g << T(r * r), T(0.0), T(0.0), T(rho * rho);
    return g;
  }
  template <class T>
  SpacePoint<T> embedding(const SurfacePoint<T>& q) const {
    using std::cos, std::sin;
    const T rho = R + outward * r * cos(q[0]);
    return {outward * r * sin(q[0]), rho * sin(q[1]), rho * cos(q[1])};
  }
  Eigen::Vector2d periods() const { return Eigen::Vector2d::Constant(2 * std::numbers::pi); }
};

/// The circle w₀ = kπ of a torus, k an integer, that is nearest to an angle w.
class TorusCircle {
 public:
  explicit TorusCircle(double w) : half_turns_(std::round(w / std::numbers::pi)) {}
  double angle() const { return half_turns_ * std::numbers::pi; }
  double outward() const { return std::fmod(half_turns_, 2) == 0 ? 1 : -1; }

 private:
  double half_turns_;
};

/// The ellipsoid x = (a sin θ cos φ, b sin θ sin φ, c cos θ) with the coordinates q = (θ, φ) and any semi-axes a, b, c.
/// The chart is singular at the poles.
struct Ellipsoid {
  static constexpr int dimension = 2;
  double a = 1, b = 1, c = 1;

  template <class T>
  SurfaceMetric<T> metric(const SurfacePoint<T>& q) const {
    using std::cos, std::sin;
    const T st = sin(q[0]), ct = cos(q[0]), sp = sin(q[1]), cp = cos(q[1]);
    const T off_diagonal = (b * b - a * a) * st * ct * sp * cp;
    SurfaceMetric<T> g;
    g << T((a * a * cp * cp + b * b * sp * sp) * ct * ct + c * c * st * st), off_diagonal, off_diagonal,
        T((a * a * sp * sp + b * b * cp * cp) * st * st);
    return g;
  }
  template <class T>
  SpacePoint<T> embedding(const SurfacePoint<T>& q) const {
    using std::cos, std::sin;
    return {a * sin(q[0]) * cos(q[1]), b * sin(q[0]) * sin(q[1]), c * cos(q[0])};
  }
  /// Returns a positive number inside the chart, and otherwise a number that is not positive. The chart ends at the
  /// angle √ε from a pole, with the machine precision ε. Closer to a pole, sin²θ is less than ε.
  template <class T>
  T reserve(const SurfacePoint<T>& q) const {
    return between_poles(q[0]);
  }
  Eigen::Vector2d periods() const { return {0, 2 * std::numbers::pi}; }
};

/// The paraboloid z = (k/2)(x² + y²) over the whole plane, with the coordinates (x, y) and the metric g = Id + k² (x,
/// y)(x, y)ᵀ.
struct Paraboloid {
  static constexpr int dimension = 2;
  double k = 1;

  template <class T>
  SurfaceMetric<T> metric(const SurfacePoint<T>& q) const {
    const T xy = k * k * q[0] * q[1];
    SurfaceMetric<T> g;
    g << T(1.0 + k * k * q[0] * q[0]), xy, xy, T(1.0 + k * k * q[1] * q[1]);
    return g;
  }
  template <class T>
  SpacePoint<T> embedding(const SurfacePoint<T>& q) const {
    return {q[0], q[1], 0.5 * k * (q[0] * q[0] + q[1] * q[1])};
  }
};

/// The hyperbolic half-plane y > 0 with ds² = (dx² + dy²)/y², whose curvature is −1. It does not have an isometric
/// embedding in ℝ³ (Hilbert 1901).
struct HyperbolicHalfPlane {
  static constexpr int dimension = 2;

  template <class T>
  SurfaceMetric<T> metric(const SurfacePoint<T>& q) const {
    const T factor = 1.0 / (q[1] * q[1]);
    SurfaceMetric<T> g;
    g << factor, T(0.0), T(0.0), factor;
    return g;
  }
  /// Returns y, which is positive inside the chart.
  template <class T>
  T reserve(const SurfacePoint<T>& q) const {
    return q[1];
  }
};

}  // namespace pseudorigid::systems
