#pragma once
/// How near the surface of an incompressible ball is to wrinkling. With λ₁ ≤ λ₂ the stretches within the surface, from
/// the metrics of its tangents t_α = ∂X/∂ξ_α before and ∂x/∂ξ_α after the deformation,
///
///   det(c − λ² C₀) = 0,   C₀_αβ = ∂_αX·∂_βX,   c_αβ = ∂_αx·∂_βx,
///
/// and λ_n = 1/(λ₁λ₂) the stretch along the normal (volume is preserved, and a surface without shear traction has its
/// normal as a principal direction), the ratio is
///
///   λ₁/λ_n = λ₁²λ₂.
///
/// A half-space of a law loses its smooth shape if it falls to the law's surface limit (materials/law_limits.h):
/// waves of every length then grow, the shorter the faster.

#include "continuum/mesh/ball_space.h"
#include "continuum/parallel/least_place.h"

namespace pseudorigid::continuum {

/// The least λ₁/λ_n over the nodes of the free surface, with X there. Collective.
LeastPlace least_surface_stretch(const BallSpace& space, const Vector& x);

}  // namespace pseudorigid::continuum
