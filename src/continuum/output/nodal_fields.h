#pragma once
/// Fields of the whole ball for graphics. Every cell brings its own (k+1)³ Gauss–Lobatto nodes, since stresses jump
/// between cells, and is cut into k³ linear hexahedra; the reflections of a sector follow, image by image.
///
///   F = (∂x/∂ξ)(∂X/∂ξ)⁻¹,   σ = (P(F) − λ_h F⁻ᵀ)Fᵀ / det F,   λ_h the multiplier of the motion, if there is one
///
/// without the stress of a viscosity. All in internal units (lengths r, stresses ρc²).

#include <cstdint>
#include <vector>

#include "continuum/body/compressible_ball.h"
#include "continuum/body/elastic_ball.h"

namespace pseudorigid::continuum {

/// What stays the same from frame to frame.
struct NodalGrid {
  std::vector<double> points;              ///< reference positions X, three per point
  std::vector<std::int64_t> connectivity;  ///< eight points per hexahedron, in VTK's order, volume > 0
};

/// Values at the points of NodalGrid.
struct NodalFields {
  std::vector<double> displacement;  ///< x − X, three per point
  std::vector<double> pressure;      ///< −tr σ / 3
  std::vector<double> jacobian;      ///< det F
  std::vector<double> von_mises;     ///< √(3/2) |dev σ|
  std::vector<double> potential;     ///< φ of self-gravity per mass; empty without
};

NodalGrid nodal_grid(const BallSpace& space);

/// `law` is that of the ball. Fails where the multiplier of the motion does, and where det F ≤ 0 at a node.
mechanics::Status nodal_fields(const ElasticBall& ball, const materials::AnyLaw& law,
                               const mechanics::State<ElasticBall>& state, ElasticBall::Workspace& workspace,
                               NodalFields& fields);
mechanics::Status nodal_fields(const CompressibleBall& ball, const materials::AnyLaw& law,
                               const mechanics::State<CompressibleBall>& state, CompressibleBall::Workspace& workspace,
                               NodalFields& fields);

}  // namespace pseudorigid::continuum
