#pragma once
/// Points that fill the unit ball, for pictures of models without elements: a cube in the middle and six shells around
/// it, equiangular towards the surface.

#include <Eigen/Core>
#include <vector>

#include "mechanics/core/body_fields.h"

namespace pseudorigid::io {

struct BallBlocks {
  std::vector<Eigen::Vector3d> points;  ///< no two at one place
  mechanics::PointBlocks blocks;
};

/// Blocks of this degree: n³ in the cube and n² in each shell.
BallBlocks ball_blocks(int degree, int n);

}  // namespace pseudorigid::io
