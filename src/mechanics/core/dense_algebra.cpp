#include "mechanics/core/dense_algebra.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
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

SingularValueDecomposition singular_value_decomposition(const Eigen::MatrixXd& A) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, double absent) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
  solver.setThreshold(absent);
  solver.compute(A);
  return solver.solve(b);
}

bool CholeskyFactor::compute(const Eigen::MatrixXd& A) { return factor_.compute(A).info() == Eigen::Success; }

Eigen::MatrixXd CholeskyFactor::solve(const Eigen::MatrixXd& B) const { return factor_.solve(B); }

void CholeskyFactor::solve_in_place(Eigen::VectorXd& b) const { factor_.solveInPlace(b); }

bool invert_on_kernel(const Eigen::MatrixXd& B, const Eigen::MatrixXd& G, Eigen::MatrixXd& T) {
  CholeskyFactor factor, gram;
  if (!factor.compute(B)) return false;
  T = factor.solve(Eigen::MatrixXd::Identity(B.rows(), B.cols()));
  if (G.rows() == 0) return true;
  const Eigen::MatrixXd reactions = T * G.transpose();
  if (!gram.compute(G * reactions)) return false;
  T -= reactions * gram.solve(reactions.transpose());
  return true;
}

Eigen::VectorXd solve_semidefinite(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) { return A.ldlt().solve(b); }

Eigen::Vector3d solve_semidefinite(const Eigen::Matrix3d& A, const Eigen::Vector3d& b) { return A.ldlt().solve(b); }

Eigen::MatrixXd solve(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) { return A.fullPivLu().solve(B); }

Eigen::VectorXcd solve_complex(const Eigen::MatrixXcd& A, const Eigen::VectorXcd& b) {
  return A.partialPivLu().solve(b);
}

}  // namespace pseudorigid::mechanics
