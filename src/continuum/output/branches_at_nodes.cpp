#include "continuum/output/branches_at_nodes.h"

#include <cstddef>

namespace pseudorigid::continuum {
namespace {

using Metric = materials::Symmetric<double>;

/// Σ μ_b C_b⁻¹ at the Gauss points of a cell, with the modulus μ_b and the internal metric C_b of each branch.
std::vector<Metric> at_points(const materials::MaxwellBranches& branches, const Vector& x, unsigned int cell,
                              std::size_t n_points) {
  std::vector<Metric> sums(n_points, Metric{});
  const double* metrics = &x.metrics[cell * branches.size() * Metric::n_entries * n_points];
  for (const materials::MaxwellBranch& branch : branches) {
    for (std::size_t q = 0; q < n_points; ++q) {
      Metric metric;
      for (std::size_t k = 0; k < Metric::n_entries; ++k) metric.a[k] = metrics[k * n_points + q];
      materials::add_branch(branch.modulus, metric, sums[q]);
    }
    metrics += Metric::n_entries * n_points;
  }
  return sums;
}

/// Interpolates values at the Gauss points of a cell to the nodes along one direction. The indices of neighbours in
/// this direction differ by `stride`.
std::vector<Metric> interpolated(const std::vector<Metric>& values, const ReferenceCell& ref, std::size_t stride) {
  const auto n = static_cast<std::size_t>(ref.n);
  std::vector<Metric> result(values.size(), Metric{});
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t place = i / stride % n, first = i - place * stride;
    for (std::size_t q = 0; q < n; ++q)
      result[i] = materials::plus(result[i], lagrange(ref.points, q, ref.nodes[place]), values[first + q * stride]);
  }
  return result;
}

}  // namespace

std::vector<materials::BranchesAtPoint> branches_at_nodes(const BallBody& ball, const Vector& x, unsigned int cell) {
  const ReferenceCell& ref = ball.space().reference_cell();
  const std::size_t n_nodes = ball.space().nodes_per_cell();
  std::vector<materials::BranchesAtPoint> result(n_nodes);
  if (!ball.relaxes()) return result;
  std::vector<Metric> sums = at_points(ball.branches(), x, cell, n_nodes);
  for (std::size_t d = 0, stride = 1; d < 3; ++d, stride *= static_cast<std::size_t>(ref.n))
    sums = interpolated(sums, ref, stride);
  for (std::size_t i = 0; i < n_nodes; ++i) result[i] = {sums[i], materials::sum_of_moduli(ball.branches())};
  return result;
}

std::vector<materials::BranchesAtPoint> branches_at_points(const BallBody& ball, const Vector& x, unsigned int cell) {
  const std::size_t n_points = ball.space().nodes_per_cell();
  std::vector<materials::BranchesAtPoint> result(n_points);
  if (!ball.relaxes()) return result;
  const std::vector<Metric> sums = at_points(ball.branches(), x, cell, n_points);
  for (std::size_t q = 0; q < n_points; ++q) result[q] = {sums[q], materials::sum_of_moduli(ball.branches())};
  return result;
}

}  // namespace pseudorigid::continuum
