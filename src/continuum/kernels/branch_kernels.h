#pragma once
/// Integrals for viscoelastic branches (materials/maxwell_branch.h) over the cells of one process, with an internal
/// metric C_b of each branch b at each Gauss point. In a list of metrics, entry k of C_b at point q of a cell is stored
/// at ((cell · n_branches + b) 6 + k) n_points + q. Vectors are pointers as in local_kernels.h.

#include <cstddef>

#include "materials/maxwell_branch.h"

namespace pseudorigid::continuum {

class BranchKernels {
 public:
  using Branches = materials::MaxwellBranches;
  virtual ~BranchKernels() = default;
  /// f ← f − ∫ΣP_b : ∇φ
  virtual void add_force(const Branches& branches, const double* metrics, const double* x, double* f) const = 0;
  /// ∫ΣW_b
  virtual double energy(const Branches& branches, const double* metrics, const double* x) const = 0;
  /// Lets the metrics relax for the time h, for the mean strain of x0 and x1. Returns the lost energy.
  virtual double relax(const Branches& branches, double h, const double* x0, const double* x1,
                       double* metrics) const = 0;
  /// Sets the metrics of all branches to Ĉ at x.
  virtual void set_to_strain(std::size_t n_branches, const double* x, double* metrics) const = 0;
};

}  // namespace pseudorigid::continuum
