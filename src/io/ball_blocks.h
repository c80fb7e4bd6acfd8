#pragma once
/// Points that fill the unit ball, for pictures of models without elements. The points form blocks. One set of blocks
/// fills a cube in the middle. Other blocks fill the six shells between the faces of the cube and the surface of the
/// ball. On a face of the cube, the rows of points are at equal angles seen from the centre.

#include <Eigen/Core>
#include <vector>

#include "mechanics/core/body_fields.h"

namespace pseudorigid::io {

struct BallBlocks {
  std::vector<Eigen::Vector3d> points;  ///< no two points have the same place
  mechanics::PointBlocks blocks;
};

/// Divides the ball into blocks of the given degree: n³ blocks in the cube and n² in each shell.
BallBlocks ball_blocks(int degree, int n);

}  // namespace pseudorigid::io
