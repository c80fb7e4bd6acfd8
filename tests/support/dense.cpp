#include "support/dense.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>

namespace pseudorigid::testing {

Eigen::VectorXd singular_values(const Eigen::MatrixXd& A) { return A.jacobiSvd().singularValues(); }

SymmetricSpectrum symmetric_spectrum(const Eigen::MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXd generalized_eigenvalues(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(A, B, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& A) { return A.eigenvalues(); }

double determinant(const Eigen::MatrixXd& A) { return A.fullPivLu().determinant(); }

Eigen::MatrixXd kernel(const Eigen::MatrixXd& A) { return A.fullPivLu().kernel(); }

}  // namespace pseudorigid::testing
