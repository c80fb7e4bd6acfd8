#include "continuum/output/observe_stress.h"

#include <Eigen/Dense>

#include "continuum/kernels/node_gradients.h"
#include "continuum/output/branches_at_nodes.h"
#include "continuum/parallel/ghost_values.h"
#include "continuum/parallel/ranks.h"
#include "materials/point_fields.h"
#include "observables/stress_sums.h"
#include "observables/whole_body.h"

namespace pseudorigid::continuum {
namespace {

/// Interpolates the values at the nodes of a cell to its Gauss points.
Eigen::Matrix3Xd at_gauss_points(const ReferenceCell& ref, Eigen::Matrix3Xd values) {
  for (int d = 0, stride = 1; d < 3; ++d, stride *= ref.n) {
    Eigen::Matrix3Xd result = Eigen::Matrix3Xd::Zero(3, values.cols());
    for (int i = 0; i < values.cols(); ++i) {
      const int q = i / stride % ref.n, first = i - q * stride;
      for (int j = 0; j < ref.n; ++j) result.col(i) += ref.interpolate[q * ref.n + j] * values.col(first + j * stride);
    }
    values = result;
  }
  return values;
}

/// Adds the Gauss points of a cell to `sums`. Fails as `observe_stress` does.
mechanics::Status add_cell(const BallBody& ball, const Vector& position, unsigned int cell,
                           mechanics::StressSums& sums) {
  const BallSpace& space = ball.space();
  const ReferenceCell& ref = space.reference_cell();
  const Eigen::Matrix3Xd X = at_gauss_points(ref, nodal_values(space, space.reference_positions(), cell)),
                         x = at_gauss_points(ref, nodal_values(space, position, cell));
  const auto branches = branches_at_points(ball, position, cell);
  for (int i = 0; i < X.cols(); ++i) {
    const Eigen::Matrix3d of_reference = gradient_on_grid(ref.differentiate, ref.n, X, i);
    const Eigen::Matrix3d F = gradient_on_grid(ref.differentiate, ref.n, x, i) * of_reference.inverse();
    Eigen::Matrix3d stress;
    if (auto status = materials::cauchy_stress(ball.law(), X.col(i), F, branches[i], stress); !status) return status;
    sums.add(stress, ref.weight_of_point(i) * of_reference.determinant(), X.col(i).norm());
  }
  return {};
}

}  // namespace

mechanics::Status observe_stress(const BallBody& ball, const Vector& x, mechanics::StressObservables& o) {
  const BallSpace& space = ball.space();
  mechanics::StressSums own;
  mechanics::Status status;
  {
    const GhostValues ghosts(x);
    for (unsigned int cell = 0; cell < space.n_cells() && status; ++cell) status = add_cell(ball, x, cell, own);
  }
  if (least_over_ranks(status ? 1 : 0, space.communicator()) < 1)
    return status ? mechanics::Status::failure("there is no stress on another rank") : status;

  o.largest = -least_over_ranks(-own.largest, space.communicator());
  o.mean = sum_over_ranks(own.integral, space.communicator()) / sum_over_ranks(own.volume, space.communicator());
  const double least_distance = least_over_ranks(own.least_distance, space.communicator());
  const bool is_central = own.least_distance <= least_distance * mechanics::StressSums::same_distance;
  const Eigen::Matrix3d central =
      sum_over_ranks(is_central ? own.central : Eigen::Matrix3d::Zero().eval(), space.communicator()) /
      sum_over_ranks(is_central ? own.n_central : 0.0, space.communicator());
  o.at_center = mechanics::von_mises(mechanics::without_odd_entries(central, space.mesh().sector().reflect));
  return {};
}

}  // namespace pseudorigid::continuum
