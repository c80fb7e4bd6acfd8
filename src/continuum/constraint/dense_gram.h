#pragma once
/// The Gram operator of a position, assembled and inverted as a dense matrix: the preconditioner of small problems, in
/// one process. Its inverse is kept in single precision, which is enough for the four digits that a solve asks for.
/// With B_c the rows G M^{-1/2} of the multipliers of cell c, the block of the cells b and a is a sum over the nodes n
/// that both have,
///
///   S_ba = Σ_n (B_b)_n (B_a)_nᵀ,
///
/// and is zero if they have none.

#include <deal.II/lac/lapack_full_matrix.h>

#include <map>
#include <utility>
#include <vector>

#include "continuum/constraint/gram_preconditioner.h"
#include "continuum/constraint/symmetric_matrix.h"
#include "continuum/kernels/cell_kernels.h"
#include "continuum/mesh/ball_space.h"

namespace pseudorigid::continuum {

class DenseGram final : public GramPreconditioner {
 public:
  DenseGram(const BallSpace& space, const CellKernels& kernels);

  mechanics::Status renew(const Vector& x) override;
  void apply(Vector& result, const Vector& r) const override { inverse_.multiply(r.begin(), result.begin()); }
  double renewal_cost() const override;
  std::size_t memory() const override;

 private:
  using Block = dealii::LAPACKFullMatrix<double>;
  /// The nodes that two cells a < b share, by their numbers in the one and in the other.
  struct SharedNodes {
    std::vector<unsigned int> in_a, in_b;
  };

  /// G M^{-1/2}, a block a cell: a row for a multiplier function, a column for a component of one of the cell's nodes.
  std::vector<Block> scaled_constraint_rows(const Vector& x) const;

  const BallSpace* space_;
  const CellKernels* kernels_;
  std::map<std::pair<unsigned int, unsigned int>, SharedNodes> shared_nodes_;
  SymmetricMatrix inverse_;
};

}  // namespace pseudorigid::continuum
