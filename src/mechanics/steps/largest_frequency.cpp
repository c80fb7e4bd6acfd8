#include "mechanics/steps/largest_frequency.h"

#include <Eigen/Eigenvalues>

namespace pseudorigid::mechanics::detail {

RitzValue largest_ritz_value(const std::vector<double>& alpha, const std::vector<double>& beta) {
  const auto n = static_cast<Eigen::Index>(alpha.size());
  const Eigen::Map<const Eigen::VectorXd> diagonal(alpha.data(), n), beside(beta.data(), n);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
  ritz.computeFromTridiagonal(diagonal, beside.head(n - 1));
  return {ritz.eigenvalues()(n - 1), std::abs(beside(n - 1) * ritz.eigenvectors()(n - 1, n - 1))};
}

}  // namespace pseudorigid::mechanics::detail
