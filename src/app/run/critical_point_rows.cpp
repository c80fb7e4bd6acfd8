#include "app/run/critical_point_rows.h"

#include <fmt/format.h>

namespace pseudorigid::app {

std::vector<scene::Column> critical_point_columns(int n_modes) {
  std::vector<scene::Column> columns{
      {"morse_index", "", "number of directions in which the potential falls"},
      {"nullity", "", "number of directions in which it is constant to second order, including those of symmetries"},
      {"n_unstable", "",
       "dimension of the unstable manifold under the system's own dissipation or, where it has none, under the force "
       "-(momentum)/(the scene's unit of time)"},
      {"n_stable", "", "dimension of the stable manifold under the same dissipation or force"}};
  for (int k = 1; k <= n_modes; ++k)
    columns.push_back({fmt::format("hessian_{}", k), "1/time^2",
                       k > 1 ? "as for hessian_1"
                             : "least eigenvalue of the potential's second derivative in the metric of the kinetic "
                               "energy, the square of a frequency; every degree of freedom k has its hessian_k"});
  for (int k = 1; k <= 2 * n_modes; ++k) {
    columns.push_back({fmt::format("rate_{}_re", k), "1/time",
                       k > 1 ? "as for rate_1_re"
                             : "real part of a rate z of small motions exp(z t) of the system itself. Without "
                               "dissipation z^2 = -hessian_k; every degree of freedom has two rates"});
    columns.push_back(
        {fmt::format("rate_{}_im", k), "1/time", k > 1 ? "as for rate_1_im" : "imaginary part of that rate"});
  }
  return columns;
}

void append_critical_point(const mechanics::CriticalPoint& point, std::vector<double>& row) {
  for (const int count : {point.morse_index, point.nullity, point.n_unstable, point.n_stable}) row.push_back(count);
  row.insert(row.end(), point.hessian_eigenvalues.begin(), point.hessian_eigenvalues.end());
  for (const auto& rate : point.rates) row.insert(row.end(), {rate.real(), rate.imag()});
}

void report_search(const mechanics::CriticalPoints& found, double energy, const RunContext& context,
                   ModelOutcome& outcome) {
  add_result(outcome, context,
             fmt::format("{} critical points from {} of {} starts (a search: there may be more)", found.points.size(),
                         found.n_converged, found.n_starts));
  for (const mechanics::CriticalPoint& p : found.points)
    add_result(outcome, context,
               fmt::format("  V = {:.6g}: Morse index {}, nullity {}, {} unstable and {} stable directions",
                           p.V * energy, p.morse_index, p.nullity, p.n_unstable, p.n_stable));
  outcome.statistics.counters["critical_points"] = static_cast<double>(found.points.size());
  outcome.statistics.counters["starts"] = found.n_starts;
  outcome.statistics.counters["converged_starts"] = found.n_converged;
}

}  // namespace pseudorigid::app
