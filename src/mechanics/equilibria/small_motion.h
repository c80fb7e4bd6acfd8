#pragma once
/// Small motions about a relative equilibrium, in the frame in which the equilibrium is at rest. A small motion is
/// Re(y exp(st)) with the rate s and the complex shape y. In coordinates in which the mass is the identity,
///
///   (s² + 2sG + K) y = 0                                                      (linear_stability.h).
///
/// The equation determines y up to a complex factor. For the start of a motion, the root mean square of |y| over the
/// mass is the amplitude ε. The phase is that for which the largest component of the displacements of seven points of
/// the surface is real and positive. Every mesh has these points as nodes, so the phase does not depend on the
/// discretisation.

#include <Eigen/Core>
#include <array>
#include <complex>

#include "mechanics/core/status.h"

namespace pseudorigid::mechanics {

struct SmallMotion {
  std::complex<double> rate;  ///< s
  Eigen::VectorXcd shape;     ///< y with |y| = 1
};

/// Sets `motion` to the small motion whose rate is nearest to `rate`, by inverse iteration. If several motions have
/// this rate, the result is one of them. Without gyroscopic terms its shape is real. Fails if the iteration does not
/// converge.
Status motion_near(const Eigen::MatrixXd& K, const Eigen::MatrixXd& G, std::complex<double> rate, SmallMotion& motion);

/// The seven points of the unit sphere: the ends of the positive axes, the three points midway between two of them, and
/// the point midway between all three.
const std::array<Eigen::Vector3d, 7>& phase_points();

/// The displacements of the phase points, one in each column.
using PhaseDisplacements = Eigen::Matrix<std::complex<double>, 3, 7>;

/// Returns the factor that gives the shape y the amplitude ε and the phase of the opening comment. If several
/// components are within 10 % of the largest, the first of them in column order becomes real and positive. `amplitude`
/// is ε, `mean_square` is the mean of |y|² over the mass and must be positive, and `displacements` are those of y.
std::complex<double> factor_of_shape(double amplitude, double mean_square, const PhaseDisplacements& displacements);

}  // namespace pseudorigid::mechanics
