#pragma once
/// A heavy particle on a rough torus (Oliva, Geometric Mechanics, 5.8.8), strongly dissipative: unit mass,
///
///   q = (sin w, (3 + cos w) sin u, (3 + cos w) cos u),   metric dw² + (3 + cos w)² du²,   D(v) = −c v,
///   V = g ⟨q, up⟩,   up = (sin α, 0, cos α).
///
/// Upright, α = 0, V = g (3 + cos w) cos u is even in x = sin w, hence w = π is invariant: it joins the two saddles,
/// whose invariant manifolds are not transversal. A tilt α ≠ 0 takes the symmetry away and breaks the connection
/// (5.8.6).

#include <Eigen/Core>
#include <cmath>

#include "systems/surfaces.h"

namespace pseudorigid::systems {

struct Torus : TorusSurface {
  double gravity = 1, c = 1, tilt = 0;

  template <class T>
  T potential(const SurfacePoint<T>& q) const {
    const SpacePoint<T> x = embedding(q);
    return gravity * (std::sin(tilt) * x[0] + std::cos(tilt) * x[2]);
  }
  Eigen::Vector2d dissipation(const Eigen::Vector2d&, const Eigen::Vector2d& v) const { return -c * v; }
};

}  // namespace pseudorigid::systems
