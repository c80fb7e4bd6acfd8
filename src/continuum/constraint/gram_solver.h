#pragma once
/// Solves G(q₁) M⁻¹ G(q₀)ᵀ λ = r for the ball without assembling the matrix, by conjugate residuals
/// (mechanics/core/conjugate_residuals.h). G is the derivative of the constraint, M is the mass, and q₀ and q₁ are
/// positions. The entries of λ are the coefficients of the Kirchhoff pressure in an L²-orthonormal basis
/// (kernels/cell_kernels.h). The preconditioner approximates the symmetric Gram operator S = G M⁻¹ Gᵀ at earlier
/// positions. Small problems in one process use the inverse of S (dense_gram.h), and other problems use two levels
/// (two_level_gram.h). Solves need more iterations if the positions are farther from those of the preconditioner. The
/// solver renews the preconditioner when the additional iterations have taken more time than a renewal.

#include <memory>

#include "continuum/constraint/gram_preconditioner.h"
#include "continuum/kernels/cell_kernels.h"
#include "continuum/mesh/ball_space.h"
#include "mechanics/core/status.h"

namespace pseudorigid::continuum {

/// The kind of preconditioner: the inverse of S as a dense matrix, or the preconditioner with two levels.
enum class GramMethod { dense, two_level };

/// Returns `dense` for up to GramSolver::n_dense multipliers in one process, and otherwise `two_level`.
GramMethod fitting_gram_method(const BallSpace& space);

class GramSolver {
 public:
  GramSolver(const BallSpace& space, const CellKernels& kernels, GramMethod method);
  ~GramSolver();
  GramSolver(GramSolver&&) noexcept;

  /// Computes λ with |(G(q₁)M⁻¹G(q₀)ᵀ + σ)λ − r| ≤ max(reduction · |r|, enough) in the Euclidean norm. σ = `shift` is 0
  /// for a rigid constraint. If history().stale is true, the solver first computes the preconditioner at q₀ for this σ.
  /// For σ > 0, the dense inverse alone may give λ, with a larger residual.
  /// If the iteration does not converge, the solver renews the preconditioner at q₁ and repeats the iteration once.
  /// Fails if the second iteration does not converge either, if the preconditioner cannot be computed, or if r is not
  /// finite. Collective.
  mechanics::SolveReport solve(const Vector& q1, const Vector& q0, const Vector& r, double enough, double shift,
                               Vector& lambda);

  /// f = −∫∂(W + U)/∂F ∇φ + G(x)ᵀλ, with the stored energy W + U of kernels/stored_energy.h and the basis functions φ.
  /// Like CellKernels::force, returns the least of J and of the law's reserve on this rank. If this value is not
  /// positive, f is not valid. With the dense preconditioner, the function also stores the tangent of the constraint at
  /// x for a later solve with q₀ = x. Collective.
  double force_with_reaction(const Vector& x, const Vector& lambda, Vector& f);
  /// f ← f + G(x)ᵀλ. With the dense preconditioner, the function uses a stored tangent of the constraint, and computes
  /// it first if the stored tangent is not that at x. Collective.
  void add_reaction(const Vector& x, const Vector& lambda, Vector& f);

  /// The members on which later solves depend. The error of a solution depends on the preconditioner. Checkpoints
  /// therefore contain these members, so that a resumed run has the same results as an uninterrupted run.
  struct History {
    Vector renewed_at;       ///< positions at which the preconditioner was last computed
    double renewed_for = 0;  ///< shift σ for which it was computed
    /// `n_iterations_fresh` is the number of iterations of the first solve after a renewal, or −1 before this solve.
    /// `n_iterations_lost` is the sum, over all later solves, of the iterations beyond this number. Solves that renew
    /// the preconditioner at q₁ do not count.
    int n_iterations_fresh = -1, n_iterations_lost = 0;
    bool stale = true;      ///< true if the next solve must compute or renew the preconditioner
    bool contracts = true;  ///< true if the inverse alone reduced the last residual after a first step enough
  };
  History& history();
  template <class Visit>
  void visit_memory(Visit&& visit) {
    auto& [renewed_at, renewed_for, n_fresh, n_lost, stale, contracts] = history();
    visit(renewed_at);
    visit(renewed_for);
    visit(n_fresh);
    visit(n_lost);
    visit(stale);
    visit(contracts);
  }

  /// Counts since the construction of the solver. n_iterations_at_most is the largest number of iterations of one
  /// solve. A solve does not count if its preconditioner cannot be computed. n_renewals includes failed renewals, but
  /// not the first computation after a restart from a checkpoint.
  struct Statistics {
    long n_solves = 0, n_iterations = 0, n_iterations_at_most = 0, n_renewals = 0;
    std::size_t memory = 0;  ///< memory of the preconditioner on this rank in bytes
  };
  Statistics statistics() const;

  /// One call of `solve` reduces the residual to this fraction of |r|, or to `enough` if `enough` is larger. The
  /// constraint loops of the methods repeat the call until their own residual is small. A call therefore need not be
  /// more accurate than a step of Newton's iteration.
  static constexpr double reduction = 1e-4;
  /// For at most this number of multipliers in one process, a step with the dense inverse is cheaper than with two
  /// levels.
  static constexpr std::size_t n_dense = 2400;

 private:
  class Impl;  // so that this header does not include the preconditioners and PETSc
  std::unique_ptr<Impl> impl_;
};

}  // namespace pseudorigid::continuum
