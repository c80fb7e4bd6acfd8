#pragma once
/// A heavy particle of unit mass on a rough torus (Oliva, Geometric Mechanics, 5.8.8), with strong dissipation. The
/// angles are w around the tube and u around the axis. The torus has the radius R of the circle in the middle of the
/// tube and the tube radius r. For R = 3 and r = 1, the position q, the metric, the friction D and the potential V are
///
///   q = (sin w, (3 + cos w) sin u, (3 + cos w) cos u),   metric dw² + (3 + cos w)² du²,
///   D(v) = −c(q) (v + β ⟨v, e⟩ e),   c(q) = c (1 + a cos w + b cos u),   e = cos γ e_w + sin γ e_u,
///   V = g ⟨q, up⟩,   up = (sin α, 0, cos α),
///
/// with the velocity v, the unit vectors e_w, e_u along the circles, the acceleration g of gravity and the tilt α. The
/// numbers a, b and β satisfy |a| + |b| < 1 and β ≥ 0. The friction D varies with the position (5.8.9) and is greater
/// along the grain direction e. For a = b = β = 0 it is the friction of 5.8.8.
///
/// For α = 0, the potential V = g (3 + cos w) cos u is even in x = sin w. The circle w = π is therefore invariant. This
/// circle connects the two saddles, whose stable and unstable manifolds are not transversal there. A tilt α ≠ 0 removes
/// the symmetry, and breaks the connection without a change of D. A grain oblique to the circle breaks the connection
/// without a change of V. Theorem 5.8.6 treats these two cases, with D fixed and with V fixed. A variable c(q) alone
/// does not break the connection, because the force −c(q) v on a motion along the circle is tangent to the circle.

#include <Eigen/Core>
#include <cmath>

#include "systems/surfaces.h"
#include "systems/systems_in_lanes.h"

namespace pseudorigid::systems {

struct Torus : TorusSurface {
  double gravity = 1, c = 1, tilt = 0;
  double c_w = 0, c_u = 0;            // numbers a, b of the variable friction c(q)
  double grain = 0, grain_angle = 0;  // strength β and angle γ of the grain

  template <class T>
  T potential(const SurfacePoint<T>& q) const {
    const SpacePoint<T> x = embedding(q);
    return gravity * (std::sin(tilt) * x[0] + std::cos(tilt) * x[2]);
  }
  /// The factor c(q) of the friction. The first coordinate of q is w − w₀ as in TorusSurface.
  template <class T>
  T damping(const SurfacePoint<T>& q) const {
    using std::cos;
    return c * (1.0 + c_w * outward * cos(q[0]) + c_u * cos(q[1]));
  }
  /// The components of the friction D(v) in the coordinates (w, u), for the velocity v = (ẇ, u̇).
  template <class T>
  SurfacePoint<T> dissipation(const SurfacePoint<T>& q, const SurfacePoint<T>& v) const {
    using std::cos;
    const T factor = -damping(q);
    if (grain == 0) return {factor * v[0], factor * v[1]};
    const T rho = R + outward * r * cos(q[0]);  // r and ρ are the lengths of the vectors ∂/∂w and ∂/∂u
    const double of_w = std::cos(grain_angle), of_u = std::sin(grain_angle);
    const T along = grain * (of_w * r * v[0] + of_u * rho * v[1]);
    return {factor * (v[0] + along * (of_w / r)), factor * (v[1] + along * of_u / rho)};
  }

  /// The greatest damping μ, which is the maximum of |⟨D(v), v⟩|/|v|² over all states.
  double greatest_damping() const { return c * (1 + std::abs(c_w) + std::abs(c_u)) * (1 + grain); }
  double depth() const { return gravity * (R * std::abs(std::cos(tilt)) + r); }  ///< depth −min V of the potential
};

}  // namespace pseudorigid::systems
