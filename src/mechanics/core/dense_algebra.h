#pragma once
/// Factorisations of dense matrices of any size. Each function of a factorisation of Eigen takes seconds to compile.
/// Therefore only dense_algebra.cpp calls them.

#include <Eigen/Cholesky>
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

/// The decomposition of a matrix A = U diag(values) Vᵀ with descending singular values and square orthogonal matrices U
/// and V.
struct SingularValueDecomposition {
  Eigen::MatrixXd U;
  Eigen::VectorXd values;
  Eigen::MatrixXd V;
};
SingularValueDecomposition singular_value_decomposition(const Eigen::MatrixXd& A);

/// Returns the shortest vector x for which |Ax − b| is smallest. A pivot counts as zero if it is at most `absent` times
/// the largest pivot.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, double absent);

/// The Cholesky factor of a symmetric matrix A.
class CholeskyFactor {
 public:
  /// Computes the factor of A. Only the lower half of A is read. Returns false if A is not positive definite.
  bool compute(const Eigen::MatrixXd& A);
  /// True if the last matrix was positive definite.
  bool is_valid() const { return factor_.info() == Eigen::Success; }
  /// Returns A⁻¹B. The factor must be valid.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;
  /// Replaces b by A⁻¹b. The factor must be valid.
  void solve_in_place(Eigen::VectorXd& b) const;

 private:
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

/// Sets T = B⁻¹ − B⁻¹Gᵀ(G B⁻¹Gᵀ)⁻¹G B⁻¹, which is the inverse of B on ker G and maps the vectors Gᵀλ to 0. Returns
/// false if the symmetric matrix B or G B⁻¹Gᵀ is not positive definite.
bool invert_on_kernel(const Eigen::MatrixXd& B, const Eigen::MatrixXd& G, Eigen::MatrixXd& T);

/// Returns A⁻¹b for a symmetric matrix A that is positive or negative semidefinite.
Eigen::VectorXd solve_semidefinite(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
Eigen::Vector3d solve_semidefinite(const Eigen::Matrix3d& A, const Eigen::Vector3d& b);
/// Returns A⁻¹B by elimination with full pivoting. A must be regular.
Eigen::MatrixXd solve(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
/// Returns A⁻¹b by elimination with partial pivoting. A must be regular.
Eigen::VectorXcd solve_complex(const Eigen::MatrixXcd& A, const Eigen::VectorXcd& b);

}  // namespace pseudorigid::mechanics
