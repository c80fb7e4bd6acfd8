#pragma once
/// The start of a motion of a polynomial body from its own figure (figures/figure_start.h).

#include <Eigen/Core>

#include "mechanics/core/status.h"
#include "polynomial/polynomial_space.h"
#include "scene/scene.h"

namespace pseudorigid::app {

/// Sets the coefficients of the positions x and velocities v of the start in `space`, which are the first entries of
/// both vectors. Fails if the body of this degree does not have the figure or the small motion, or if the small motion
/// does not have the symmetry planes of the space.
mechanics::Status start_from_figure(const scene::Scene& scene, const polynomial::PolynomialSpace& space,
                                    Eigen::VectorXd& x, Eigen::VectorXd& v);

}  // namespace pseudorigid::app
