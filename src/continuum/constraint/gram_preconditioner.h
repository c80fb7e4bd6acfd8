#pragma once
/// A preconditioner of the operator S + σ at given positions, with the Gram operator S = G M⁻¹Gᵀ, the derivative G of
/// the constraint and the mass M. The shift σ ≥ 0 is 0 unless the constraint is compliant (mechanics/methods/rattle.h).

#include <cstddef>

#include "continuum/parallel/types.h"
#include "mechanics/core/status.h"

namespace pseudorigid::continuum {

class GramPreconditioner {
 public:
  virtual ~GramPreconditioner() = default;

  /// Computes the preconditioner for the positions x and σ = `shift`. Must be called before `apply`. Fails if a matrix
  /// of the preconditioner at x cannot be factorised, for example because the Gram operator is singular. After a
  /// failure, `apply` must not be called. Collective.
  virtual mechanics::Status renew(const Vector& x, double shift) = 0;
  /// Sets `result` to an approximation of (S + σ)⁻¹ r. The approximate inverse is symmetric and positive definite.
  /// Collective.
  virtual void apply(Vector& result, const Vector& r) const = 0;
  /// Estimate of the time of `renew`, in units of the time of one iteration of GramSolver::solve.
  virtual double renewal_cost() const = 0;
  /// Memory on this rank in bytes.
  virtual std::size_t memory() const = 0;
};

}  // namespace pseudorigid::continuum
