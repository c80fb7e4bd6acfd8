#pragma once
/// Factorisations of dense matrices of any size. Each takes seconds to compile, so only dense_algebra.cpp compiles
/// them.

#include <Eigen/Core>

namespace pseudorigid::mechanics {

/// Spectrum of a symmetric matrix A = V diag(values) Vᵀ, with V = `vectors` and ascending values.
struct SymmetricSpectrum {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
SymmetricSpectrum symmetric_spectrum(const Eigen::MatrixXd& A);

/// Spectrum of a matrix, A X = X diag(values) with X = `vectors`.
struct Spectrum {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
  bool converged;
};
Spectrum spectrum(const Eigen::MatrixXd& A);

/// Orthonormal basis of {x: Bx = 0}. Singular values below `absent` times the largest count as zero.
Eigen::MatrixXd null_space(const Eigen::MatrixXd& B, double absent);
/// Orthonormal basis of the span of the columns of N, with the same bound for singular values.
Eigen::MatrixXd span_of(const Eigen::MatrixXd& N, double absent);

/// A⁻¹B by elimination with full pivoting.
Eigen::MatrixXd solve(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

}  // namespace pseudorigid::mechanics
