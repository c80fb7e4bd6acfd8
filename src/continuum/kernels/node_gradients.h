#pragma once
/// Nodal values of one cell and their derivatives at the nodes. Only functions that are called rarely use this file,
/// such as the renewal of the preconditioner, the surface stretch and the pictures. Forces and constraints use the
/// faster functions of cell_kernels.h.

#include <Eigen/Core>
#include <vector>

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

/// ∂x/∂ξ at point i of a grid of n³ points, with one column for each direction ξ_d. x contains the values at the
/// points. `differentiate` maps the values of a row of n points to the derivatives at these points.
inline Eigen::Matrix3d gradient_on_grid(const std::vector<double>& differentiate, int n, const Eigen::Matrix3Xd& x,
                                        int i) {
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  for (int d = 0, stride = 1; d < 3; ++d, stride *= n) {
    const int position = i / stride % n, first = i - position * stride;
    for (int j = 0; j < n; ++j) gradient.col(d) += differentiate[position * n + j] * x.col(first + j * stride);
  }
  return gradient;
}

/// ∂x/∂ξ at node i of a cell. x contains the nodal values of the cell.
inline Eigen::Matrix3d reference_gradient(const ReferenceCell& ref, const Eigen::Matrix3Xd& x, int i) {
  return gradient_on_grid(ref.differentiate_at_nodes, ref.n, x, i);
}

}  // namespace pseudorigid::continuum
