#pragma once
/// Factorisations of dense matrices of any size. Each factorisation of Eigen takes seconds to compile. Therefore only
/// dense_algebra.cpp contains them.

#include <Eigen/Core>

namespace pseudorigid::mechanics {

/// Spectrum of a symmetric matrix A = V diag(values) Vᵀ. The columns of the orthogonal matrix V = `vectors` are the
/// eigenvectors, and `values` has the eigenvalues in ascending order.
struct SymmetricSpectrum {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
/// Returns the spectrum of A. Only the lower half of A is read.
SymmetricSpectrum symmetric_spectrum(const Eigen::MatrixXd& A);

/// Spectrum of a real matrix A with A X = X diag(values). The columns of X = `vectors` are the eigenvectors. `values`
/// and `vectors` are valid only if `converged` is true.
struct Spectrum {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
  bool converged;
};
/// Returns the spectrum of A. The eigenvectors have the length 1.
Spectrum spectrum(const Eigen::MatrixXd& A);

/// Returns an orthonormal basis of {x: Bx = 0} as columns. If B has no rows, the basis is the identity. A singular
/// value counts as zero if it is at most `absent` times the largest singular value.
Eigen::MatrixXd null_space(const Eigen::MatrixXd& B, double absent);
/// Returns an orthonormal basis of the span of the columns of N. N must have at least one column. A singular value
/// counts as zero if it is at most `absent` times the largest singular value.
Eigen::MatrixXd span_of(const Eigen::MatrixXd& N, double absent);

/// Returns A⁻¹B by elimination with full pivoting. A must be regular.
Eigen::MatrixXd solve(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
/// Returns A⁻¹b by elimination with partial pivoting. A must be regular.
Eigen::VectorXcd solve_complex(const Eigen::MatrixXcd& A, const Eigen::VectorXcd& b);

}  // namespace pseudorigid::mechanics
