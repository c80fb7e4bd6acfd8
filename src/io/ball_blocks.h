#pragma once
/// Points that fill the unit ball, for pictures of models without elements. The points form blocks
/// (mechanics::PointBlocks). Some blocks fill a cube in the middle. The other blocks fill the six shells between the
/// faces of the cube and the surface of the ball. On a face of the cube, the rows of points are at equal angles seen
/// from the centre of the ball.

#include <Eigen/Core>
#include <vector>

#include "mechanics/core/body_fields.h"

namespace pseudorigid::io {

/// The points of the ball, and the blocks that they form. `blocks.points` contains indices into `points`.
struct BallBlocks {
  std::vector<Eigen::Vector3d> points;  ///< in the ball of radius 1; all points are different
  mechanics::PointBlocks blocks;
};

/// Divides the ball into blocks of (degree + 1)³ points: n³ blocks in the cube and n² blocks in each shell. Both
/// arguments must be at least 1.
BallBlocks ball_blocks(int degree, int n);

}  // namespace pseudorigid::io
