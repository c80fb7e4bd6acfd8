#pragma once
/// The start of a motion of the finite-element ball from its own figure (figures/figure_start.h).

#include "continuum/mesh/ball_space.h"
#include "mechanics/core/status.h"
#include "scene/scene.h"

namespace pseudorigid::app {

/// Sets x and v to the positions and velocities of the start, at the nodes of `space` that this rank owns. Both vectors
/// must be 0 before the call. The mesh of `space` is a sector with this number of refinements. Each rank computes the
/// figure on its own. Fails if the mesh does not have the figure or the small motion, or if the small motion does not
/// have the symmetry planes of the sector.
mechanics::Status start_from_figure(const scene::Scene& scene, int n_refinements, const continuum::BallSpace& space,
                                    continuum::Vector& x, continuum::Vector& v);

}  // namespace pseudorigid::app
