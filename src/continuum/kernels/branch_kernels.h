#pragma once
/// Integrals for viscoelastic branches (materials/maxwell_branch.h) over the cells of one process. Branch b has the
/// stress P_b, the stored energy W_b and the internal metric C_b at each Gauss point. In a list of metrics, entry k of
/// C_b at point q of a cell has the index ((cell · n_branches + b) · 6 + k) · n_points + q. The entries k = 0 … 5 are
/// 00, 01, 02, 11, 12, 22. Vectors such as x and f are pointers to the entries of this process, as in local_kernels.h.

#include <cstddef>

#include "materials/maxwell_branch.h"

namespace pseudorigid::continuum {

class BranchKernels {
 public:
  using Branches = materials::MaxwellBranches;
  virtual ~BranchKernels() = default;
  /// f ← f − ∫ΣP_b : ∇φ at the position x, with the basis functions φ.
  virtual void add_force(const Branches& branches, const double* metrics, const double* x, double* f) const = 0;
  /// The stored energy ∫ΣW_b dX at the position x.
  virtual double energy(const Branches& branches, const double* metrics, const double* x) const = 0;
  /// Replaces the metrics by their values after the time h. During this time the strain is constant: it is
  /// materials::mean_strain of the positions x0 and x1. Returns the energy that each branch loses in the cells of this
  /// process.
  virtual materials::BranchEnergies relax(const Branches& branches, double h, const double* x0, const double* x1,
                                          double* metrics) const = 0;
  /// Sets the metrics of all branches to the isochoric strain Ĉ = J^{−2/3} FᵀF at x, so that the branches have no
  /// stress.
  virtual void set_to_strain(std::size_t n_branches, const double* x, double* metrics) const = 0;
};

}  // namespace pseudorigid::continuum
