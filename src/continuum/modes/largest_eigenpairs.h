#pragma once
/// Largest eigenvalues of a symmetric operator by SLEPc (Krylov–Schur), in the orthogonal complement of known
/// eigenvectors. A Krylov space contains only one vector of each eigenspace. One call therefore finds only one
/// eigenvector of a multiple eigenvalue. Later calls find the other eigenvectors.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "continuum/modes/shell_operator.h"

namespace pseudorigid::continuum {

struct EigenPair {
  double value;
  std::vector<double> vector;
};

/// Appends the n_wanted largest eigenpairs that are not in `known`, or a few more, in descending order of the
/// eigenvalues. Their vectors are orthogonal to those in `known`. If the operator has fewer than n_wanted other pairs,
/// all of them are appended. `apply` must be symmetric. `size` is the number of entries of a vector. The norm of a
/// residual is below `tolerance` times the eigenvalue, for an eigenvector of norm 1. Fails if a product fails, if SLEPc
/// reports an error, or if the iteration does not converge; `known` then does not change.
mechanics::Status append_largest_eigenpairs(const LinearOperator& apply, std::size_t size, int n_wanted,
                                            double tolerance, std::vector<EigenPair>& known);

}  // namespace pseudorigid::continuum
