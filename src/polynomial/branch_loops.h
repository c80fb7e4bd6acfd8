#pragma once
/// Loops over the quadrature points for viscoelastic branches (materials/maxwell_branch.h), for the table of
/// dense_kernels.h. A branch has an internal metric at each point, a symmetric matrix with six entries. With n points,
/// the entry k of the metric of branch b at point p is stored at (6b + k) n + p.

#include "materials/maxwell_branch.h"
#include "polynomial/point_lanes.h"

namespace pseudorigid::polynomial {
namespace {

using Metric = materials::Symmetric<L>;

inline Metric load_metric(const double* metrics, int b, int n, int p) {
  Metric metric;
  for (int k = 0; k < Metric::n_entries; ++k)
    metric.a[k] = load(metrics + static_cast<long>(Metric::n_entries * b + k) * n + p);
  return metric;
}

/// Σ μ_b C_b⁻¹ at the points p, p + 1, … in the lanes of a vector. Branch b has the modulus μ_b and the metric C_b.
inline Metric inverse_sum(const materials::MaxwellBranches& branches, const double* metrics, int n, int p) {
  Metric A{};
  for (std::size_t b = 0; b < branches.size(); ++b)
    materials::add_branch(branches[b].modulus, load_metric(metrics, static_cast<int>(b), n, p), A);
  return A;
}

void add_branch_stress(const materials::MaxwellBranches& branches, int n, const double* w, const double* metrics,
                       const double* F, double* T) {
  for (int p = 0; p < n; p += n_lanes) {
    const Tensor P = materials::stress_of_branches(load(F, n, p), inverse_sum(branches, metrics, n, p));
    store(add(load(T, n, p), load(w + p) * P), T, n, p);
  }
}

double branch_energy(const materials::MaxwellBranches& branches, int n, const double* w, const double* metrics,
                     const double* F) {
  const double moduli = materials::sum_of_moduli(branches);
  L energy = 0;
  for (int p = 0; p < n; p += n_lanes)
    energy += load(w + p) * materials::energy_of_branches(load(F, n, p), inverse_sum(branches, metrics, n, p), moduli);
  return energy.sum(n_lanes);
}

materials::BranchEnergies relax_branches(const materials::MaxwellBranches& branches, double h, int n, const double* w,
                                         const double* F0, const double* F1, double* metrics) {
  std::array<L, materials::most_branches> lost{};
  for (int p = 0; p < n; p += n_lanes) {
    const Metric strain = materials::mean_strain(load(F0, n, p), load(F1, n, p));
    for (std::size_t b = 0; b < branches.size(); ++b) {
      Metric metric = load_metric(metrics, static_cast<int>(b), n, p);
      const double x = h / branches[b].relaxation_time;
      lost[b] += load(w + p) * (branches[b].modulus * materials::relax(strain, x, metric));
      for (int k = 0; k < Metric::n_entries; ++k)
        store(metric.a[k], metrics + static_cast<long>(Metric::n_entries * static_cast<int>(b) + k) * n + p);
    }
  }
  materials::BranchEnergies sums{};
  for (std::size_t b = 0; b < branches.size(); ++b) sums[b] = lost[b].sum(n_lanes);
  return sums;
}

}  // namespace
}  // namespace pseudorigid::polynomial
