#pragma once
/// The operator S + σ with the Gram operator S = G M⁻¹Gᵀ at given positions and the shift σ, assembled and inverted as
/// a dense matrix. G is the derivative of the constraint, and M is the mass. The inverse is the preconditioner of small
/// problems in one process. Its entries have single precision, because a solve needs only about four digits
/// (GramSolver::reduction). Let B_c be the rows of G M^{-1/2} for the multipliers of cell c, and (B_c)_n the columns of
/// node n. The block of S for the multipliers of the cells b and a is a sum over their shared nodes n,
///
///   S_ba = Σ_n (B_b)_n (B_a)_nᵀ,
///
/// and is zero if the cells do not share a node.

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

  mechanics::Status renew(const Vector& x, double shift) override;
  void apply(Vector& result, const Vector& r) const override { inverse_.multiply(r.begin(), result.begin()); }
  double renewal_cost() const override;
  std::size_t memory() const override;

 private:
  using Block = dealii::LAPACKFullMatrix<double>;
  /// The nodes that two cells a < b share. `in_a` has the number of each node in cell a, and `in_b` its number in cell
  /// b.
  struct SharedNodes {
    std::vector<unsigned int> in_a, in_b;
  };

  /// G M^{-1/2} at the positions x, one block for each cell. A row belongs to a multiplier function, and a column to a
  /// component of a node of the cell.
  std::vector<Block> scaled_constraint_rows(const Vector& x) const;

  const BallSpace* space_;
  const CellKernels* kernels_;
  /// The shared nodes of each pair of cells a < b, if there are any.
  std::map<std::pair<unsigned int, unsigned int>, SharedNodes> shared_nodes_;
  SymmetricMatrix inverse_;
};

}  // namespace pseudorigid::continuum
