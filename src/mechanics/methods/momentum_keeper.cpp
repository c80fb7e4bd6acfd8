#include "mechanics/methods/momentum_keeper.h"

#include <Eigen/QR>

namespace pseudorigid::mechanics::detail {

Eigen::VectorXd least_solution(const Eigen::MatrixXd& gram, const Eigen::VectorXd& lost) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver(gram.rows(), gram.cols());
  solver.setThreshold(1e-8);
  solver.compute(gram);
  return solver.solve(lost);
}

}  // namespace pseudorigid::mechanics::detail
