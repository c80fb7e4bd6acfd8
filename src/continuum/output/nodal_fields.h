#pragma once
/// Fields of the whole ball for pictures. Every cell has its own (k+1)³ Gauss–Lobatto nodes, because stresses are
/// discontinuous between cells. The points of the mirror images follow the points of the sector, image by image.
///
///   F = (∂x/∂ξ)(∂X/∂ξ)⁻¹,   σ = (P(F) − (λ_h − ρ(φ − φ̄)) F⁻ᵀ)Fᵀ / det F
///
/// F is the deformation gradient, and σ is the Cauchy stress. P is the stress of the law and of the viscoelastic
/// branches, without volumetric stabilisation and viscosity. λ_h is the multiplier of the motion, or 0 without
/// constraint. With self-gravity, φ is the potential. The constant φ̄ follows from ρφ̄V = (5/3)Ê with the volume V and
/// the energy Ê of self-gravity (gravity/surface_gravity.h). The force of Ê has no component that a pressure could
/// balance, so λ_h is not the Kirchhoff pressure. The term with φ corrects the difference, and is 0 without
/// self-gravity. All fields have internal units (entries/units.h).

#include <vector>

#include "continuum/body/compressible_ball.h"
#include "continuum/body/elastic_ball.h"
#include "mechanics/core/body_fields.h"

namespace pseudorigid::continuum {

/// Returns a block of points for each cell of this rank and for each mirror image of such a cell. The degree of the
/// blocks is the degree of the elements.
mechanics::PointBlocks nodal_blocks(const BallSpace& space);

/// The reference positions X at the points of the blocks, with three numbers per point.
std::vector<double> nodal_positions(const BallSpace& space);

/// Sets `fields` at the points of `nodal_blocks`. Also sets the centre of mass c and the moment Σ m_n (x_n − c) X_nᵀ
/// over the nodes n of the whole ball. Fails if the multiplier of the motion cannot be computed, or if det F is not
/// positive and finite at a node of this rank. Collective.
mechanics::Status nodal_fields(const ElasticBall& ball, const mechanics::State<ElasticBall>& state,
                               ElasticBall::Workspace& workspace, mechanics::BodyFields& fields);
mechanics::Status nodal_fields(const CompressibleBall& ball, const mechanics::State<CompressibleBall>& state,
                               CompressibleBall::Workspace& workspace, mechanics::BodyFields& fields);

/// Interpolates values from the Gauss–Lobatto nodes of each cell to the same number of equidistant points. The first
/// function is for a list with three numbers for each node. The second function is for all fields.
void make_equidistant(const BallSpace& space, std::vector<double>& values);
void make_equidistant(const BallSpace& space, mechanics::BodyFields& fields);

}  // namespace pseudorigid::continuum
