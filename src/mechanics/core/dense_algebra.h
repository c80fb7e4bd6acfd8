#pragma once
/// Factorisations of dense matrices of any size. Each takes seconds to compile, so this is the one place where that is
/// done.

#include <Eigen/Core>

namespace pseudorigid::mechanics {

/// A = V diag(values) Vᵀ of a symmetric A, in ascending order.
struct SymmetricSpectrum {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
SymmetricSpectrum symmetric_spectrum(const Eigen::MatrixXd& A);

/// A X = X diag(values).
struct Spectrum {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
  bool converged;
};
Spectrum spectrum(const Eigen::MatrixXd& A);

/// Orthonormal basis of {x: Bx = 0}. Singular values below that part of the largest count as zero.
Eigen::MatrixXd null_space(const Eigen::MatrixXd& B, double absent);
/// Orthonormal basis of the span of the columns, in the same way.
Eigen::MatrixXd span_of(const Eigen::MatrixXd& N, double absent);

/// A⁻¹B, with full pivoting.
Eigen::MatrixXd solve(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

}  // namespace pseudorigid::mechanics
