#pragma once
/// Nodal values of one cell and their derivatives at the nodes. Only functions that are called rarely use this file,
/// such as the renewal of the preconditioner, the surface stretch and the pictures. Forces and constraints use the
/// faster functions of cell_kernels.h.

#include <Eigen/Core>

#include "continuum/mesh/ball_space.h"

namespace pseudorigid::continuum {

/// Nodal values of a cell, one column for each node, with the first local direction as the fastest index. The ghost
/// nodes of the cell must be up to date.
inline Eigen::Matrix3Xd nodal_values(const BallSpace& space, const Vector& x, unsigned int cell) {
  const auto& nodes = space.cell_nodes(cell);
  Eigen::Matrix3Xd values(3, nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int c = 0; c < 3; ++c) values(c, i) = x.local_element(3 * nodes[i] + c);
  return values;
}

/// ∂x/∂ξ at node i of a cell, with one column for each direction ξ_d. x contains the nodal values of the cell.
inline Eigen::Matrix3d reference_gradient(const ReferenceCell& ref, const Eigen::Matrix3Xd& x, int i) {
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  for (int d = 0, stride = 1; d < 3; ++d, stride *= ref.n) {
    const int position = i / stride % ref.n, first = i - position * stride;
    for (int j = 0; j < ref.n; ++j)
      gradient.col(d) += ref.differentiate_at_nodes[position * ref.n + j] * x.col(first + j * stride);
  }
  return gradient;
}

}  // namespace pseudorigid::continuum
