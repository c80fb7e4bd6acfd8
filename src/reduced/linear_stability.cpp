#include "reduced/linear_stability.h"

#include "mechanics/core/dense_algebra.h"

namespace pseudorigid::reduced::detail {

Eigen::MatrixXd tangent_space(const SteadyMotion& m, bool incompressible) {
  if (!incompressible) return Eigen::MatrixXd::Identity(9, 9);
  return mechanics::null_space(flat(m.A.inverse().transpose()).transpose(), absent);
}

mechanics::SymmetryDirections turns(const SteadyMotion& m, const Eigen::MatrixXd& T) {
  const Eigen::Index n = T.cols();
  mechanics::SymmetryDirections N{Eigen::MatrixXd(n, 6), Eigen::MatrixXd(n, 6)};
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d zeta = Eigen::Vector3d::Unit(k);
    const auto hat = [](const Eigen::Vector3d& w) { return mechanics::cross_matrix(w); };
    N.y.col(k) = T.transpose() * flat(hat(zeta) * m.A);
    N.rate.col(k) = T.transpose() * flat(-hat(m.omega.cross(zeta)) * m.A);
    N.y.col(3 + k) = T.transpose() * flat(m.A * hat(zeta));
    N.rate.col(3 + k) = T.transpose() * flat(-m.A * hat(m.Lambda.cross(zeta)));
  }
  return N;
}

}  // namespace pseudorigid::reduced::detail
