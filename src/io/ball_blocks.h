#pragma once
/// Points that fill the unit ball, for pictures of models without elements. They form blocks: a cube in the middle and
/// six shells between its faces and the surface. The points on a face of the cube are at equal angles seen from the
/// centre.

#include <Eigen/Core>
#include <vector>

#include "mechanics/core/body_fields.h"

namespace pseudorigid::io {

struct BallBlocks {
  std::vector<Eigen::Vector3d> points;  ///< no two points have the same place
  mechanics::PointBlocks blocks;
};

/// Blocks of the given degree: n³ blocks in the cube and n² in each shell.
BallBlocks ball_blocks(int degree, int n);

}  // namespace pseudorigid::io
