#pragma once
/// Largest eigenvalues of a symmetric operator by SLEPc (Krylov–Schur), in the complement of eigenvectors that are
/// known. A Krylov space holds one vector of each eigenspace; copies of an eigenvalue come out one run after the other.

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "mechanics/core/status.h"

namespace pseudorigid::continuum {

/// Its first failure ends the iteration.
using SymmetricOperator = std::function<mechanics::Status(std::span<const double>, std::span<double>)>;

struct EigenPair {
  double value;
  std::vector<double> vector;
};

/// Appends n_wanted pairs or a few more to `known`, by falling value and orthogonal to its vectors. It appends fewer if
/// no more exist. Residuals are below `tolerance` times the eigenvalue.
mechanics::Status append_largest_eigenpairs(const SymmetricOperator& apply, std::size_t size, int n_wanted,
                                            double tolerance, std::vector<EigenPair>& known);

}  // namespace pseudorigid::continuum
