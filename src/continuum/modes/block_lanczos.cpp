#include "continuum/modes/block_lanczos.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "mechanics/core/dense_algebra.h"

namespace pseudorigid::continuum {
namespace {

constexpr Eigen::Index n_columns_of_block = 8;
/// The iteration fails if the basis exceeds this number of vectors, plus `n_vectors_of_pair` for each wanted eigenpair.
constexpr Eigen::Index n_least_vectors = 300, n_vectors_of_pair = 30;

}  // namespace

BlockLanczos::BlockLanczos(BlockOperator A, Eigen::Index size, Eigen::MatrixXd excluded)
    : A_(std::move(A)), size_(size), excluded_(std::move(excluded)) {
  if (excluded_.cols() == 0) excluded_.resize(size_, 0);
  Eigen::MatrixXd start(size_, n_columns_of_block);
  for (auto column : start.colwise()) column = random_vector();
  append(start, std::numeric_limits<double>::epsilon());
}

Eigen::VectorXd BlockLanczos::random_vector() {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Eigen::VectorXd::NullaryExpr(size_, [&] { return uniform(generator_); }).normalized();
}

bool BlockLanczos::orthonormalize(Eigen::VectorXd& q, double least) const {
  const auto V = V_.leftCols(n_basis_);
  double before = std::numeric_limits<double>::infinity(), length = q.norm();
  while (length > least && length < 0.7 * before) {  // a part that hardly becomes shorter is orthogonal to round-off
    before = length;
    q -= V * (V.transpose() * q).eval();
    q -= excluded_ * (excluded_.transpose() * q).eval();
    length = q.norm();
  }
  if (!(length > least)) return false;
  q /= length;
  return true;
}

void BlockLanczos::append(const Eigen::MatrixXd& w, double least) {
  const Eigen::Index n = std::min(w.cols(), n_all() - n_basis_);
  if (n_basis_ + n > V_.cols()) V_.conservativeResize(size_, std::min(n_all(), n_basis_ + 4 * n_columns_of_block));
  for (Eigen::Index j = 0; j < n; ++j) {
    Eigen::VectorXd q = w.col(j);
    while (!orthonormalize(q, least)) {
      q = random_vector();
      least = std::numeric_limits<double>::epsilon();
    }
    V_.col(n_basis_++) = q;
  }
}

mechanics::Status BlockLanczos::expand() {
  const Eigen::Index n_before = n_multiplied_, n = n_basis_, n_block = n - n_before;
  Eigen::MatrixXd w;
  if (auto status = A_(V_.middleCols(n_before, n_block), w); !status) return status;
  const Eigen::MatrixXd H = V_.leftCols(n).transpose() * w;
  w -= V_.leftCols(n) * H;
  T_.conservativeResize(n, n);
  T_.rightCols(n_block) = H;
  T_.bottomRows(n_block) = H.transpose();
  T_.bottomRightCorner(n_block, n_block) = (H.bottomRows(n_block) + H.bottomRows(n_block).transpose()) / 2;
  n_multiplied_ = n;
  append(w, std::numeric_limits<double>::epsilon() * T_.norm());
  R_ = V_.middleCols(n, n_basis_ - n).transpose() * w;
  if (!T_.allFinite())
    return mechanics::Status::failure("a product of the iteration for the eigenvectors is not finite");
  const mechanics::SymmetricSpectrum ritz = mechanics::symmetric_spectrum(T_);
  theta_ = ritz.values.reverse();
  s_ = ritz.vectors.rowwise().reverse();
  return {};
}

bool BlockLanczos::have_converged(Eigen::Index n, double tolerance) const {
  if (n_multiplied_ < n) return false;
  const Eigen::MatrixXd residuals = R_ * s_.bottomRows(R_.cols()).leftCols(n);
  for (Eigen::Index i = 0; i < n; ++i)
    if (!(residuals.col(i).norm() <= tolerance * theta_[i])) return false;
  return true;
}

mechanics::Status BlockLanczos::find(Eigen::Index n, double tolerance) {
  n = std::min(n, n_all());
  while (!have_converged(n, tolerance)) {
    if (n_multiplied_ > n_least_vectors + n_vectors_of_pair * n)
      return mechanics::Status::failure("the iteration for the eigenvectors does not converge");
    if (auto status = expand(); !status) return status;
  }
  n_found_ = n;
  return {};
}

Eigen::MatrixXd BlockLanczos::vectors() const { return V_.leftCols(n_multiplied_) * s_.leftCols(n_found_); }

}  // namespace pseudorigid::continuum
