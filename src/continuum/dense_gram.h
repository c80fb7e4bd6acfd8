#pragma once
/// The Gram operator of a position, assembled and inverted as a dense matrix: the preconditioner of small problems, in
/// one process. Its inverse is kept in single precision, which is enough for the four digits that a solve asks for.

#include "continuum/ball_space.h"
#include "continuum/cell_kernels.h"
#include "continuum/gram_preconditioner.h"
#include "continuum/packed_symmetric.h"

namespace pseudorigid::continuum {

class DenseGram final : public GramPreconditioner {
 public:
  DenseGram(const BallSpace& space, const CellKernels& kernels) : space_(&space), kernels_(&kernels) {}

  mechanics::Status renew(const Vector& x) override;
  void apply(Vector& result, const Vector& r) const override { inverse_.multiply(r.begin(), result.begin()); }
  bool stale_after(int n_iterations) override;
  std::size_t memory() const override { return inverse_.memory(); }

 private:
  const BallSpace* space_;
  const CellKernels* kernels_;
  PackedSymmetric inverse_;
  int n_iterations_fresh_ = -1, n_iterations_lost_ = 0;
};

}  // namespace pseudorigid::continuum
