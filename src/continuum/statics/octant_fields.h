#pragma once
/// Nodal fields on an octant of the ball, and their continuation to other sectors. A displacement with the parity s
/// (modes/parity.h) satisfies u(R_j X) = s_j R_j u(X) under the reflection R_j of axis j. Positions have s = (1, 1, 1).

#include <vector>

#include "continuum/mesh/ball_space.h"
#include "continuum/modes/parity.h"
#include "continuum/statics/figure_stability.h"
#include "mechanics/equilibria/small_motion.h"

namespace pseudorigid::continuum {

/// Continues fields of an octant to a sector whose mesh has the same degree and refinements, without a grading. Each
/// rank has the whole octant and continues the field to its own nodes.
class OctantContinuation {
 public:
  /// Throws std::logic_error if a node of the sector has no image in the octant.
  OctantContinuation(const BallSpace& octant, const BallSpace& sector);

  /// Adds the field u of the octant, times `factor`, to `field` at the nodes of the sector that this rank owns.
  void add(double factor, const Parity& parity, const Vector& u, Vector& field) const;

 private:
  struct Image {
    unsigned int node;       ///< node of the octant
    unsigned int reflected;  ///< bit j is set if X_j < 0
  };
  std::vector<Image> images_;  ///< for each node of the sector
};

/// The mean of |y|², weighted with the mass, for the shape y of a small motion. `octant` is the space of its parts.
double mean_square(const BallSpace& octant, const SmallMotionOfBall& motion);

/// The displacements of the seven phase points on the surface, one in each column
/// (mechanics/equilibria/small_motion.h). These points are nodes of every mesh of the octant.
mechanics::PhaseDisplacements at_phase_points(const BallSpace& octant, const SmallMotionOfBall& motion);

}  // namespace pseudorigid::continuum
