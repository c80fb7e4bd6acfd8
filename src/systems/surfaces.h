#pragma once
/// Metrics of given surfaces, for their geodesic flow (Oliva, Geometric Mechanics, 5.3, F = 0). Each surface in ℝ³
/// knows its embedding x(q), and its metric is the induced one, g = DxᵀDx, in closed form.

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

/// Positive for an angle from the axis that is in no pole's reach.
template <class T>
T between_poles(const T& theta) {
  using std::min;
  constexpr double margin = 0x1p-26;
  return min(T(theta - margin), T(std::numbers::pi - margin - theta));
}

/// x = R (sin θ cos φ, sin θ sin φ, cos θ),  ds² = R² (dθ² + sin²θ dφ²). Singular at the poles.
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
  /// Positive between the poles. Nearer to a pole than √ε, sin²θ is below round-off.
  template <class T>
  T reserve(const SurfacePoint<T>& q) const {
    return between_poles(q[0]);
  }
  Eigen::Vector2d periods() const { return {0, 2 * std::numbers::pi}; }
};

/// The torus of revolution about the x axis (5.8.8): x = (r sin w, ρ sin u, ρ cos u) with ρ = R + r cos w,
/// ds² = r² dw² + ρ² du².
///
/// Its symmetric circles are w = 0, outside, and w = π, inside. A motion that a symmetry keeps on one of them stays
/// there in floating-point arithmetic if its own angle is 0: π is not a number of double precision, and sin of the
/// nearest one is not 0. So the first coordinate is w − w₀ with w₀ = 0 or π (TorusCircle).
struct TorusSurface {
  static constexpr int dimension = 2;
  double R = 3, r = 1;
  double outward = 1;  // cos w₀: 1 if the angle is measured from outside, −1 from inside

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

/// The symmetric circle w₀ = kπ of a torus that is nearest to an angle w.
class TorusCircle {
 public:
  explicit TorusCircle(double w) : half_turns_(std::round(w / std::numbers::pi)) {}
  double angle() const { return half_turns_ * std::numbers::pi; }
  double outward() const { return std::fmod(half_turns_, 2) == 0 ? 1 : -1; }

 private:
  double half_turns_;
};

/// x = (a sin θ cos φ, b sin θ sin φ, c cos θ) with any semi-axes. Singular at the poles.
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
  /// Positive between the poles. Nearer to a pole than √ε, sin²θ is below round-off.
  template <class T>
  T reserve(const SurfacePoint<T>& q) const {
    return between_poles(q[0]);
  }
  Eigen::Vector2d periods() const { return {0, 2 * std::numbers::pi}; }
};

/// z = (k/2)(x² + y²) over the whole plane: g = Id + k² (x, y)(x, y)ᵀ.
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

/// The hyperbolic half-plane y > 0: ds² = (dx² + dy²)/y², of curvature −1. It has no embedding in ℝ³ (Hilbert 1901).
struct HyperbolicHalfPlane {
  static constexpr int dimension = 2;

  template <class T>
  SurfaceMetric<T> metric(const SurfacePoint<T>& q) const {
    const T factor = 1.0 / (q[1] * q[1]);
    SurfaceMetric<T> g;
    g << factor, T(0.0), T(0.0), factor;
    return g;
  }
  template <class T>
  T reserve(const SurfacePoint<T>& q) const {
    return q[1];
  }
};

}  // namespace pseudorigid::systems
