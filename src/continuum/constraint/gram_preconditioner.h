#pragma once
/// Preconditioner of the Gram operator S = G M⁻¹Gᵀ of a position.

#include <cstddef>

#include "continuum/parallel/types.h"
#include "mechanics/core/status.h"

namespace pseudorigid::continuum {

class GramPreconditioner {
 public:
  virtual ~GramPreconditioner() = default;

  /// Computes the preconditioner for the positions x. Fails if the Gram operator is singular there. Collective.
  virtual mechanics::Status renew(const Vector& x) = 0;
  /// result ≈ S⁻¹ r, by a symmetric positive definite operator. Collective.
  virtual void apply(Vector& result, const Vector& r) const = 0;
  /// Cost of its renewal, in iterations of a solve.
  virtual double renewal_cost() const = 0;
  /// Bytes held on this rank.
  virtual std::size_t memory() const = 0;
};

}  // namespace pseudorigid::continuum
