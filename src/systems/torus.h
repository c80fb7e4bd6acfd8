#pragma once
/// A heavy particle on a rough torus (Oliva, Geometric Mechanics, 5.8.8), strongly dissipative: unit mass,
///
///   q = (sin w, (3 + cos w) sin u, (3 + cos w) cos u),   metric dw² + (3 + cos w)² du²,
///   D(v) = −c(q) (v + β ⟨v, e⟩ e),   c(q) = c (1 + a cos w + b cos u),   e = cos γ e_w + sin γ e_u,
///   V = g ⟨q, up⟩,   up = (sin α, 0, cos α),
///
/// with e_w, e_u the unit vectors along the circles, |a| + |b| < 1 and β ≥ 0: friction that changes from place to place
/// (5.8.9), and is greater along a grain e. With a = b = β = 0 it is that of 5.8.8.
///
/// Upright, α = 0, V = g (3 + cos w) cos u is even in x = sin w, hence w = π is invariant: it joins the two saddles,
/// whose invariant manifolds are not transversal. A tilt α ≠ 0 takes the symmetry away and breaks the connection, with
/// the same D; a grain that is oblique to the circle does, with the same V (the two halves of 5.8.6). No c(q) does:
/// −c(q) v is along the circle where v is.

#include <Eigen/Core>
#include <cmath>

#include "systems/surfaces.h"
#include "systems/systems_in_lanes.h"

namespace pseudorigid::systems {

struct Torus : TorusSurface {
  double gravity = 1, c = 1, tilt = 0;
  double c_w = 0, c_u = 0;            // a, b
  double grain = 0, grain_angle = 0;  // β, γ

  template <class T>
  T potential(const SurfacePoint<T>& q) const {
    const SpacePoint<T> x = embedding(q);
    return gravity * (std::sin(tilt) * x[0] + std::cos(tilt) * x[2]);
  }
  /// c(q); q is measured as in TorusSurface.
  template <class T>
  T damping(const SurfacePoint<T>& q) const {
    using std::cos;
    return c * (1.0 + c_w * outward * cos(q[0]) + c_u * cos(q[1]));
  }
  template <class T>
  SurfacePoint<T> dissipation(const SurfacePoint<T>& q, const SurfacePoint<T>& v) const {
    using std::cos;
    const T factor = -damping(q);
    if (grain == 0) return {factor * v[0], factor * v[1]};
    const T rho = R + outward * r * cos(q[0]);  // r and ρ are the lengths of ∂/∂w and ∂/∂u
    const double of_w = std::cos(grain_angle), of_u = std::sin(grain_angle);
    const T along = grain * (of_w * r * v[0] + of_u * rho * v[1]);
    return {factor * (v[0] + along * (of_w / r)), factor * (v[1] + along * of_u / rho)};
  }

  /// μ, the greatest ratio |⟨D(v), v⟩|/|v|² anywhere, and −min V.
  double greatest_damping() const { return c * (1 + std::abs(c_w) + std::abs(c_u)) * (1 + grain); }
  double depth() const { return gravity * (R * std::abs(std::cos(tilt)) + r); }
};

}  // namespace pseudorigid::systems
