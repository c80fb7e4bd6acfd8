#pragma once
/// Solves G(q₁) M⁻¹ G(q₀)ᵀ λ = r for the ball. The symmetric Gram operator S = G M⁻¹ Gᵀ of some earlier position is
/// assembled and factorised (sparse Cholesky); the factor preconditions GMRES on the operator asked for, matrix-free,
/// and is renewed when the iterations show that it has become stale.

#include <Eigen/CholmodSupport>
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

#include "continuum/ball_space.h"
#include "continuum/cell_kernels.h"
#include "mechanics/status.h"

namespace pseudorigid::continuum {

class GramSolver {
 public:
  GramSolver(const BallSpace& space, const CellKernels& kernels);

  /// λ with |G(q₁)M⁻¹G(q₀)ᵀλ − r| ≤ reduction · |r| in the Euclidean norm. Fails if a fresh factor does not help.
  mechanics::SolveReport solve(const Vector& q1, const Vector& q0, const Vector& r, Vector& lambda);

  long n_factorizations() const { return n_factorizations_; }
  /// Entries of the factor.
  long factor_entries() const { return factor_entries_; }

  /// Reduction of the residual by one call. The constraint loops of the methods ask again until their own residual is
  /// small, so that a call need not go further than Newton's iteration does in one step.
  static constexpr double reduction = 1e-4;
  /// A solve that takes more iterations than this renews the factor before the next one.
  static constexpr int n_iterations_of_stale_factor = 4;

 private:
  mechanics::Status factorize(const Vector& x);
  mechanics::SolveReport iterate(const Vector& q1, const Vector& q0, const Vector& r, Vector& lambda);
  void apply_factor(Vector& result, const Vector& r) const;

  const BallSpace* space_;
  const CellKernels* kernels_;
  // Up to this many multipliers S is dense anyway, and applying its inverse is one product without a library's
  // overhead.
  static constexpr Eigen::Index n_dense = 400;
  using Cholesky = Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>>;
  std::unique_ptr<Cholesky> factor_;  // on the heap: it cannot be moved, a workspace can
  Eigen::MatrixXd dense_inverse_;     // in place of the factor where S is small
  Vector reaction_;
  bool stale_ = true;
  long n_factorizations_ = 0, factor_entries_ = 0;
};

}  // namespace pseudorigid::continuum
