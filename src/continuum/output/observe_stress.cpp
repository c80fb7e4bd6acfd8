#include "continuum/output/observe_stress.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <string>

#include "continuum/kernels/node_gradients.h"
#include "continuum/output/branches_at_nodes.h"
#include "continuum/parallel/ghost_values.h"
#include "continuum/parallel/ranks.h"
#include "materials/point_fields.h"
#include "observables/stress_sums.h"
#include "observables/whole_body.h"

namespace pseudorigid::continuum {
namespace {

/// The sums of this rank over its nodes, and the sum and the number of the stresses at the nodes nearest to the centre.
struct NodalSums {
  mechanics::StressSums stress;
  Eigen::Matrix3d at_center = Eigen::Matrix3d::Zero();
  double n_at_center = 0;
};

/// The least |X| of a node over all ranks. Collective.
double least_distance(const BallSpace& space) {
  double least = std::numeric_limits<double>::infinity();
  for (unsigned int cell = 0; cell < space.n_cells(); ++cell)
    least = std::min(least, nodal_values(space, space.reference_positions(), cell).colwise().norm().minCoeff());
  return least_over_ranks(least, space.communicator());
}

/// The weight of node i in the Gauss–Lobatto rule of the reference cell.
double weight_of_node(const ReferenceCell& ref, int i) {
  return ref.node_weights[i % ref.n] * ref.node_weights[i / ref.n % ref.n] * ref.node_weights[i / ref.n / ref.n];
}

/// Adds the nodes of a cell to `sums`. The nodes at distances up to `central` from the origin count as nearest to the
/// centre. Fails as `observe_stress` does.
mechanics::Status add_cell(const BallBody& ball, const Vector& position, unsigned int cell, double central,
                           NodalSums& sums) {
  const BallSpace& space = ball.space();
  const ReferenceCell& ref = space.reference_cell();
  const Eigen::Matrix3Xd X = nodal_values(space, space.reference_positions(), cell),
                         x = nodal_values(space, position, cell);
  const auto branches = branches_at_nodes(ball, position, cell);
  for (int i = 0; i < static_cast<int>(space.nodes_per_cell()); ++i) {
    const Eigen::Matrix3d of_reference = reference_gradient(ref, X, i);
    const Eigen::Matrix3d F = reference_gradient(ref, x, i) * of_reference.inverse();
    Eigen::Matrix3d stress;
    if (auto status = materials::cauchy_stress(ball.law(), X.col(i), F, branches[i], stress); !status) return status;
    sums.stress.add(stress, weight_of_node(ref, i) * of_reference.determinant());
    if (X.col(i).norm() > central) continue;
    sums.at_center += stress;
    ++sums.n_at_center;
  }
  return {};
}

}  // namespace

mechanics::Status observe_stress(const BallBody& ball, const Vector& x, mechanics::StressObservables& o) {
  const BallSpace& space = ball.space();
  const double central = least_distance(space) + 1e-9;
  NodalSums own;
  mechanics::Status status;
  {
    const GhostValues ghosts(x);
    for (unsigned int cell = 0; cell < space.n_cells() && status; ++cell)
      status = add_cell(ball, x, cell, central, own);
  }
  if (least_over_ranks(status ? 1 : 0, space.communicator()) < 1)
    return status ? mechanics::Status::failure("there is no stress on another rank") : status;

  o.largest = -least_over_ranks(-own.stress.largest, space.communicator());
  o.mean = sum_over_ranks(own.stress.integral, space.communicator()) /
           sum_over_ranks(own.stress.volume, space.communicator());
  const Eigen::Matrix3d sum = sum_over_ranks(own.at_center, space.communicator());
  o.at_center = mechanics::von_mises(mechanics::without_odd_entries(
      sum / sum_over_ranks(own.n_at_center, space.communicator()), space.mesh().sector().reflect));
  return {};
}

}  // namespace pseudorigid::continuum
