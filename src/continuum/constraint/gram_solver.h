#pragma once
/// Solves G(q₁) M⁻¹ G(q₀)ᵀ λ = r for the ball, matrix-free, by conjugate residuals
/// (mechanics/core/conjugate_residuals.h) preconditioned for the symmetric Gram operator S = G M⁻¹ Gᵀ of some earlier
/// position: with its inverse (dense_gram.h) while that is small, beyond and on several ranks with two levels
/// (two_level_gram.h). The preconditioner is renewed when the iterations that its age has cost exceed the cost of a new
/// one.

#include <memory>

#include "continuum/constraint/gram_preconditioner.h"
#include "continuum/kernels/cell_kernels.h"
#include "continuum/mesh/ball_space.h"
#include "mechanics/core/status.h"

namespace pseudorigid::continuum {

enum class GramMethod { dense, two_level };

/// The method for a space: dense up to `n_dense` multipliers in one process.
GramMethod fitting_gram_method(const BallSpace& space);

class GramSolver {
 public:
  GramSolver(const BallSpace& space, const CellKernels& kernels, GramMethod method);
  ~GramSolver();
  GramSolver(GramSolver&&) noexcept;

  /// λ with |G(q₁)M⁻¹G(q₀)ᵀλ − r| ≤ max(reduction · |r|, enough) in the Euclidean norm. Fails if a fresh preconditioner
  /// does not help.
  mechanics::SolveReport solve(const Vector& q1, const Vector& q0, const Vector& r, double enough, Vector& lambda);

  /// f = −∫∂(W + U)/∂F ∇φ + G(x)ᵀλ, as CellKernels; with the dense inverse it remembers the tangent for a
  /// solve at x.
  double force_with_reaction(const Vector& x, const Vector& lambda, Vector& f);
  /// f += G(x)ᵀλ.
  void add_reaction(const Vector& x, const Vector& lambda, Vector& f);

  /// State on which later solves depend. A resumed run that has it repeats the whole one, whose residuals depend on the
  /// preconditioner.
  struct History {
    Vector renewed_at;  ///< the positions of the preconditioner
    int n_iterations_fresh = -1, n_iterations_lost = 0;
    bool stale = true;  ///< or not made yet
  };
  History& history();
  template <class Visit>
  void visit_memory(Visit&& visit) {
    auto& [renewed_at, n_fresh, n_lost, stale] = history();
    visit(renewed_at);
    visit(n_fresh);
    visit(n_lost);
    visit(stale);
  }

  struct Statistics {
    long n_solves = 0, n_iterations = 0, n_iterations_at_most = 0, n_renewals = 0;
    std::size_t memory = 0;  ///< bytes of the preconditioner on this rank
  };
  Statistics statistics() const;

  /// Reduction of the residual by one call. The constraint loops of the methods call again until their own residual is
  /// small, so one call need not do more than a step of Newton's iteration.
  static constexpr double reduction = 1e-4;
  /// Up to this many multipliers in one process the dense inverse makes a step cheaper than two levels do.
  static constexpr std::size_t n_dense = 2400;

 private:
  class Impl;  // on the heap, because PETSc keeps its address and a workspace can be moved
  std::unique_ptr<Impl> impl_;
};

}  // namespace pseudorigid::continuum
