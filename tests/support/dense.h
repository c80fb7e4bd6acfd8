#pragma once
/// Factorisations of Eigen for tests, compiled once: each takes seconds wherever a source asks for it.

#include <Eigen/Core>

namespace pseudorigid::testing {

/// Singular values, the largest first.
Eigen::VectorXd singular_values(const Eigen::MatrixXd& A);

/// A = V diag(values) Vᵀ of a symmetric A, the least value first.
struct SymmetricSpectrum {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
SymmetricSpectrum symmetric_spectrum(const Eigen::MatrixXd& A);

/// Eigenvalues of A x = λ B x with symmetric A and positive definite B, the least first.
Eigen::VectorXd generalized_eigenvalues(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// Eigenvalues of any A, in no order.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& A);

double determinant(const Eigen::MatrixXd& A);

/// Columns that span {x: Ax = 0}.
Eigen::MatrixXd kernel(const Eigen::MatrixXd& A);

}  // namespace pseudorigid::testing
