#pragma once
/// Fields of the whole ball for pictures. Every cell brings its own (k+1)³ Gauss–Lobatto nodes, since stresses jump
/// between cells; the reflections of a sector follow, image by image.
///
///   F = (∂x/∂ξ)(∂X/∂ξ)⁻¹,   σ = (P(F) − λ_h F⁻ᵀ)Fᵀ / det F,   λ_h the multiplier of the motion, if there is one
///
/// without the stress of a viscosity. All in internal units (lengths r, stresses ρc²).

#include <vector>

#include "continuum/body/compressible_ball.h"
#include "continuum/body/elastic_ball.h"
#include "mechanics/core/body_fields.h"

namespace pseudorigid::continuum {

/// A block for each cell, of its degree.
mechanics::PointBlocks nodal_blocks(const BallSpace& space);

/// X at the points of the blocks, three a point.
std::vector<double> nodal_positions(const BallSpace& space);

/// Fields at these points. `law` is that of the ball. Fails if the multiplier of the motion does, and if
/// det F ≤ 0 at a node.
mechanics::Status nodal_fields(const ElasticBall& ball, const materials::AnyLaw& law,
                               const mechanics::State<ElasticBall>& state, ElasticBall::Workspace& workspace,
                               mechanics::BodyFields& fields);
mechanics::Status nodal_fields(const CompressibleBall& ball, const materials::AnyLaw& law,
                               const mechanics::State<CompressibleBall>& state, CompressibleBall::Workspace& workspace,
                               mechanics::BodyFields& fields);

/// From the Gauss–Lobatto nodes of each cell to as many equidistant points, by the polynomials on the nodes.
void make_equidistant(const BallSpace& space, std::vector<double>& values);
void make_equidistant(const BallSpace& space, mechanics::BodyFields& fields);

}  // namespace pseudorigid::continuum
