#include "continuum/modes/linear_problem.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "continuum/modes/surface_harmonics.h"

namespace pseudorigid::continuum {

void LinearProblem::set_constraint(const CellKernels& kernels, const Vector& x) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  constraint.clear();
  kernels.constraint_rows(x, [&](unsigned int, std::span<const double> rows) {
    constraint.emplace_back(Eigen::Map<const RowMajor>(rows.data(), space.n_pressure(), 3 * space.nodes_per_cell()));
  });
}

void LinearProblem::set_stiffness(const std::function<Eigen::MatrixXd(unsigned int cell)>& of_cell) {
  stiffness.clear();
  n_cells_at_node.assign(space.n_nodes(), 0);
  for (unsigned int cell = 0; cell < space.n_cells(); ++cell) {
    Eigen::MatrixXd K = of_cell(cell);
    if (incompressible) {
      K.selfadjointView<Eigen::Lower>().rankUpdate(constraint[cell].transpose(), penalty);
      K.triangularView<Eigen::StrictlyUpper>() = K.transpose();
    }
    stiffness.push_back(std::move(K));
    for (const unsigned int node : space.cell_nodes(cell)) ++n_cells_at_node[node];
  }
}

std::vector<Spring> LinearProblem::add_springs(const std::function<Eigen::Vector3d(const FacePoint& point)>& along) {
  std::vector<Spring> springs;
  for (const CellFace& face : free_surface(space)) {
    const auto& nodes = space.cell_nodes(face.cell);
    Eigen::MatrixXd& K = stiffness[face.cell];
    for (const FacePoint& point : harmonic_quadrature(space, face)) {
      const Eigen::Vector3d spring = std::sqrt(point.weight) * along(point);
      Eigen::VectorXd row = Eigen::VectorXd::Zero(K.rows());
      for (const FacePoint::Node& n : point.nodes)
        row.segment<3>(3 * (std::ranges::find(nodes, n.node) - nodes.begin())) += n.value * spring;
      K += row * row.transpose();
      springs.push_back({face.cell, std::move(row)});
    }
  }
  return springs;
}

}  // namespace pseudorigid::continuum
