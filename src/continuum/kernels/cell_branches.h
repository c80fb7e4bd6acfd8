#pragma once
/// The integrals of branch_kernels.h for elements of one degree, computed plane by plane (cell_planes.h).

#include <cstddef>

#include "continuum/kernels/branch_kernels.h"
#include "continuum/kernels/cell_planes.h"

namespace pseudorigid::continuum {

template <int degree, int n_lanes>
class CellBranches final : public BranchKernels {
  using Planes = CellPlanes<degree, n_lanes>;
  using L = typename Planes::L;
  using Tensor = typename Planes::Tensor;
  using Metric = materials::Symmetric<L>;
  static constexpr int n = Planes::n, plane = Planes::plane;
  static constexpr std::size_t n_points = Planes::n_nodes, n_entries = Metric::n_entries;

 public:
  explicit CellBranches(const Planes& planes) : planes_(planes) {}

  /// With the stress P of all branches, the integrand in reference coordinates is −w P (∂X/∂ξ)⁻ᵀ : ∂φ/∂ξ. The weight is
  /// w = ŵ det ∂X/∂ξ with the weight ŵ on the reference cell. Therefore w (∂X/∂ξ)⁻ᵀ = ŵ cof ∂X/∂ξ.
  void add_force(const Branches& branches, const double* metrics, const double* x, double* f) const override {
    auto& buffers = planes_.buffers();
    for_each_plane(x, [&](std::size_t b, int q3) {
      for (int q = 0; q < plane; ++q) {
        const Tensor P = materials::stress_of_branches(Planes::load(buffers.H, q),
                                                       inverse_sum(branches, metrics, b, q3 * plane + q));
        const Tensor cof = materials::cofactor(Planes::load(buffers.dX, q));
        const double weight = -planes_.batches.unit_weights[q3 * plane + q];
        Planes::store(entrywise([&](const L& t) { return weight * t; }, materials::product(P, cof)), q, buffers.H);
      }
      planes_.integrate_plane(buffers.H, q3);
      if (q3 + 1 < n) return;
      planes_.distribute_layers();
      planes_.batches.scatter_add(buffers.result, b, f);
    });
  }

  double energy(const Branches& branches, const double* metrics, const double* x) const override {
    auto& buffers = planes_.buffers();
    const double moduli = materials::sum_of_moduli(branches);
    double sum = 0;
    for_each_plane(x, [&](std::size_t b, int q3) {
      L of_plane(0.0);
      for (int q = 0; q < plane; ++q)
        of_plane += buffers.weights[q] *
                    materials::energy_of_branches(Planes::load(buffers.H, q),
                                                  inverse_sum(branches, metrics, b, q3 * plane + q), moduli);
      sum += of_plane.sum(planes_.batches.batches[b].n_active);
    });
    return sum;
  }

  materials::BranchEnergies relax(const Branches& branches, double h, const double* x0, const double* x1,
                                  double* metrics) const override {
    auto& buffers = planes_.buffers();
    materials::BranchEnergies sums{};
    for (std::size_t b = 0; b < planes_.n_batches(); ++b) {
      load_batch(x1, b);
      planes_.load_layers(x0, b, buffers.v);
      for (int q3 = 0; q3 < n; ++q3) {
        planes_.plane_gradient(buffers.v, q3, buffers.dv);
        planes_.deformation_gradients(q3, buffers.dv);
        planes_.plane_gradient(buffers.x, q3, buffers.H);
        planes_.deformation_gradients(q3, buffers.H);
        Losses lost{};
        for (int q = 0; q < plane; ++q) {
          const Metric strain = materials::mean_strain(Planes::load(buffers.dv, q), Planes::load(buffers.H, q));
          relax_point(branches, h, strain, buffers.weights[q], b, q3 * plane + q, metrics, lost);
        }
        for (std::size_t branch = 0; branch < branches.size(); ++branch)
          sums[branch] += lost[branch].sum(planes_.batches.batches[b].n_active);
      }
    }
    return sums;
  }

  void set_to_strain(std::size_t n_branches, const double* x, double* metrics) const override {
    auto& buffers = planes_.buffers();
    for_each_plane(x, [&](std::size_t b, int q3) {
      for (int q = 0; q < plane; ++q)
        for (std::size_t branch = 0; branch < n_branches; ++branch)
          store(materials::isochoric_strain(Planes::load(buffers.H, q)), n_branches, branch, b, q3 * plane + q,
                metrics);
    });
  }

 private:
  using Losses = std::array<L, materials::most_branches>;

  void load_batch(const double* x, std::size_t b) const {
    auto& buffers = planes_.buffers();
    planes_.load_layers(x, b, buffers.x);
    planes_.load_layers(planes_.batches.reference_positions, b, buffers.X);
  }

  /// Calls use(batch, plane) for each plane of points. During the call, buffers.H contains F at the position x,
  /// buffers.dX contains ∂X/∂ξ, and buffers.weights contains the weights w = ŵ det ∂X/∂ξ.
  template <class Use>
  void for_each_plane(const double* x, const Use& use) const {
    auto& buffers = planes_.buffers();
    for (std::size_t b = 0; b < planes_.n_batches(); ++b) {
      load_batch(x, b);
      for (int q3 = 0; q3 < n; ++q3) {
        planes_.plane_gradient(buffers.x, q3, buffers.H);
        planes_.deformation_gradients(q3, buffers.H);
        use(b, q3);
      }
    }
  }

  /// Replaces the metrics of all branches at point q by their values after the time h, for the strain Ĉ. Adds the
  /// energy that each branch loses at this point, times the weight of the point, to `lost`.
  void relax_point(const Branches& branches, double h, const Metric& strain, const L& weight, std::size_t b, int q,
                   double* metrics, Losses& lost) const {
    for (std::size_t branch = 0; branch < branches.size(); ++branch) {
      Metric metric = load(metrics, branches.size(), branch, b, q);
      const double x = h / branches[branch].relaxation_time;
      lost[branch] += weight * (branches[branch].modulus * materials::relax(strain, x, metric));
      store(metric, branches.size(), branch, b, q, metrics);
    }
  }

  /// Index of the entry k = 0 of a metric in a list of metrics, for the branch `branch` at point q of the cell in a
  /// lane of batch b. Lanes that repeat the first cell of a batch use the metric of this cell.
  std::size_t place(std::size_t n_branches, std::size_t branch, std::size_t b, int lane, int q) const {
    const auto& batch = planes_.batches.batches[b];
    const std::size_t cell = batch.first_cell + static_cast<std::size_t>(lane < batch.n_active ? lane : 0);
    return (cell * n_branches + branch) * n_entries * n_points + static_cast<std::size_t>(q);
  }
  Metric load(const double* metrics, std::size_t n_branches, std::size_t branch, std::size_t b, int q) const {
    std::size_t places[n_lanes];
    for (int l = 0; l < n_lanes; ++l) places[l] = place(n_branches, branch, b, l, q);
    Metric metric;
    for (std::size_t k = 0; k < n_entries; ++k)
      metric.a[k] = L::of([&](int l) { return metrics[places[l] + k * n_points]; });
    return metric;
  }
  void store(const Metric& metric, std::size_t n_branches, std::size_t branch, std::size_t b, int q,
             double* metrics) const {
    for (int l = 0; l < planes_.batches.batches[b].n_active; ++l) {
      const std::size_t first = place(n_branches, branch, b, l, q);
      for (std::size_t k = 0; k < n_entries; ++k) metrics[first + k * n_points] = metric.a[k][l];
    }
  }
  /// Σ μ_b C_b⁻¹ at point q of a batch, with the modulus μ_b and the metric C_b of each branch.
  Metric inverse_sum(const Branches& branches, const double* metrics, std::size_t b, int q) const {
    Metric A;
    for (L& entry : A.a) entry = L(0.0);
    for (std::size_t branch = 0; branch < branches.size(); ++branch)
      materials::add_branch(branches[branch].modulus, load(metrics, branches.size(), branch, b, q), A);
    return A;
  }

  const Planes& planes_;
};

}  // namespace pseudorigid::continuum
