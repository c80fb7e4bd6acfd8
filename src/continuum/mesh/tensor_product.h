#pragma once
/// Products of values on a tensor grid of a cell with a matrix in each direction.

#include <Eigen/Core>

namespace pseudorigid::continuum {

/// Returns (A₀⊗A₁⊗A₂) u. A_d acts on direction d, and the first direction is the fastest index of u and of the result.
inline Eigen::VectorXd tensor_product(const Eigen::MatrixXd& A0, const Eigen::MatrixXd& A1, const Eigen::MatrixXd& A2,
                                      const Eigen::Ref<const Eigen::VectorXd>& u) {
  const Eigen::Index m0 = A0.rows(), m1 = A1.rows(), m2 = A2.rows(), n1 = A1.cols(), n2 = A2.cols();
  const Eigen::MatrixXd along_0 = A0 * Eigen::Map<const Eigen::MatrixXd>(u.data(), A0.cols(), n1 * n2);
  Eigen::MatrixXd along_1(m0 * m1, n2);
  for (Eigen::Index layer = 0; layer < n2; ++layer)
    Eigen::Map<Eigen::MatrixXd>(along_1.col(layer).data(), m0, m1).noalias() =
        along_0.middleCols(layer * n1, n1) * A1.transpose();
  Eigen::VectorXd result(m0 * m1 * m2);
  Eigen::Map<Eigen::MatrixXd>(result.data(), m0 * m1, m2).noalias() = along_1 * A2.transpose();
  return result;
}

}  // namespace pseudorigid::continuum
