#include "mechanics/core/dense_algebra.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>

namespace pseudorigid::mechanics {
namespace {

Eigen::Index rank(const Eigen::VectorXd& singular_values, double absent) {
  return (singular_values.array() > absent * singular_values[0]).count();
}

}  // namespace

SymmetricSpectrum symmetric_spectrum(const Eigen::MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Spectrum spectrum(const Eigen::MatrixXd& A) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors(), solver.info() == Eigen::Success};
}

Eigen::MatrixXd null_space(const Eigen::MatrixXd& B, double absent) {
  if (B.rows() == 0) return Eigen::MatrixXd::Identity(B.cols(), B.cols());
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(B, Eigen::ComputeFullV);
  return svd.matrixV().rightCols(B.cols() - rank(svd.singularValues(), absent));
}

Eigen::MatrixXd span_of(const Eigen::MatrixXd& N, double absent) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(N, Eigen::ComputeThinU);
  return svd.matrixU().leftCols(rank(svd.singularValues(), absent));
}

Eigen::MatrixXd solve(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) { return A.fullPivLu().solve(B); }

Eigen::VectorXcd solve_complex(const Eigen::MatrixXcd& A, const Eigen::VectorXcd& b) {
  return A.partialPivLu().solve(b);
}

}  // namespace pseudorigid::mechanics
