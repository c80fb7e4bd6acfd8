#pragma once
/// Largest eigenvalues θ of a symmetric operator A by the block Lanczos method, with orthogonalisation against the
/// whole basis and without restarts. The basis V has orthonormal columns. Each step multiplies the last block Q of V,
///
///   A Q = V H + Q₊ R,
///
/// and appends the next block Q₊. The matrix T = VᵀA V of the multiplied columns has the eigenpairs (θ, s). V s is then
/// an approximate eigenvector, and the norm of its residual is that of R s_Q, with the entries s_Q of s for the block
/// Q.
///
/// A block reads a factorised matrix once for all of its columns, and finds as many copies of a multiple eigenvalue as
/// it has columns. (Golub and Van Loan, Matrix Computations, section 10.3.)

#include <Eigen/Core>
#include <functional>
#include <random>

#include "mechanics/core/status.h"

namespace pseudorigid::continuum {

/// A function that sets z to A y, for each column y.
using BlockOperator = std::function<mechanics::Status(const Eigen::MatrixXd& y, Eigen::MatrixXd& z)>;

class BlockLanczos {
 public:
  /// Eigenvectors have `size` entries and are orthogonal to the columns of `excluded`, which must be orthonormal
  /// eigenvectors.
  BlockLanczos(BlockOperator A, Eigen::Index size, Eigen::MatrixXd excluded = {});

  /// Finds the n largest eigenpairs, or all of them if there are fewer. Later calls go on from there. The norm of a
  /// residual is at most `tolerance` times the eigenvalue, for an eigenvector of norm 1. Fails if a product fails or if
  /// the iteration does not converge.
  mechanics::Status find(Eigen::Index n, double tolerance);
  Eigen::Index n_found() const { return n_found_; }
  /// The eigenvalues that `find` has found, in descending order, and their orthonormal eigenvectors as columns.
  Eigen::VectorXd values() const { return theta_.head(n_found_); }
  Eigen::MatrixXd vectors() const;
  /// The number of columns that A has multiplied.
  Eigen::Index n_products() const { return n_multiplied_; }

 private:
  Eigen::Index n_all() const { return size_ - excluded_.cols(); }  ///< number of all eigenpairs
  bool have_converged(Eigen::Index n, double tolerance) const;
  mechanics::Status expand();
  /// Appends to V orthonormal vectors whose span contains the parts of the columns of w that are orthogonal to V. Parts
  /// shorter than `least` are replaced by random vectors.
  void append(const Eigen::MatrixXd& w, double least);
  /// Makes q orthogonal to V and of length 1. Returns false if its orthogonal part is shorter than `least`.
  bool orthonormalize(Eigen::VectorXd& q, double least) const;
  Eigen::VectorXd random_vector();

  BlockOperator A_;
  Eigen::Index size_, n_basis_ = 0, n_multiplied_ = 0, n_found_ = 0;
  Eigen::MatrixXd excluded_;
  Eigen::MatrixXd V_;         ///< the first n_basis_ columns are V
  Eigen::MatrixXd T_;         ///< of the first n_multiplied_ columns of V
  Eigen::MatrixXd R_;         ///< of the last block
  Eigen::VectorXd theta_;     ///< eigenvalues of T in descending order
  Eigen::MatrixXd s_;         ///< their eigenvectors
  std::mt19937 generator_{};  ///< has a constant seed, so that results are reproducible
};

}  // namespace pseudorigid::continuum
