#pragma once
/// A measure of the distance of an incompressible ball from wrinkling of its surface. Let λ₁ ≤ λ₂ be the principal
/// stretches within the surface. These stretches follow from the metrics of the tangents ∂X/∂ξ_α before and ∂x/∂ξ_α
/// after the deformation,
///
///   det(c − λ² C₀) = 0,   C₀_αβ = ∂_αX·∂_βX,   c_αβ = ∂_αx·∂_βx.
///
/// The normal of a surface without shear traction is a principal direction. Because the volume is constant, the stretch
/// along the normal is λ_n = 1/(λ₁λ₂). The measure is the ratio
///
///   λ₁/λ_n = λ₁²λ₂.
///
/// A half-space becomes unstable if the ratio falls to the surface limit of its law (materials/law_limits.h).
/// Perturbations of every wavelength then grow, and the shortest waves grow fastest.

#include "continuum/mesh/ball_space.h"
#include "continuum/parallel/least_place.h"

namespace pseudorigid::continuum {

/// The least λ₁/λ_n over the nodes of the free surface of all ranks, with the reference position X of its node.
/// Collective.
LeastPlace least_surface_stretch(const BallSpace& space, const Vector& x);

}  // namespace pseudorigid::continuum
