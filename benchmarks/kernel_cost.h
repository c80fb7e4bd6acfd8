#pragma once
/// Operations and bytes of one cell: the kernels' own templates run on a scalar that counts, bytes by what is read and
/// written once a call (a vector that is added to is read and written, one that is cleared before is written once
/// more).

#include <string>

namespace pseudorigid::benchmarks {

struct CellCost {
  double flops;       ///< additions, multiplications and divisions, one each; a fused pair is two
  double cell_bytes;  ///< geometry, indices, pressure basis, multipliers
};

/// `kernel` is force, constraint, rate, reaction or stiffness; degree 2 … 8.
CellCost cell_cost(const std::string& kernel, int degree);
/// The force by FEEvaluation (fe_evaluation_force.h), with deal.II's sweeps on a number that counts. The bytes are
/// those of the stored geometry and of the indices. Degree 2 … 8.
CellCost fe_evaluation_cost(int degree);

}  // namespace pseudorigid::benchmarks
