#include "app/systems/equilibria.h"

#include <fmt/format.h>

#include <string>

#include "io/csv.h"
#include "mechanics/equilibria/critical_points.h"

namespace pseudorigid::app {
namespace {

/// A linear damping that every system can be given: the force −M v, in units of the scene.
Eigen::MatrixXd unit_damping(const mechanics::AnyLandscape& landscape, const Eigen::VectorXd& q) {
  Eigen::MatrixXd M;
  landscape.mass(q, M);
  return M;
}

/// The rates as they are without any added damping.
mechanics::Status find_own_rates(const mechanics::AnyLandscape& landscape, mechanics::CriticalPoint& p) {
  mechanics::CriticalPoint undamped;
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(p.q.size(), p.q.size());
  mechanics::Status status = mechanics::describe_critical_point(landscape, p.q, p.lambda, none, undamped);
  if (status) p.rates = undamped.rates;
  return status;
}

std::vector<double> equilibria_row(int index, const mechanics::CriticalPoint& p,
                                   const std::vector<scene::Column>& columns, const systems::Scales& scales) {
  std::vector<double> row{static_cast<double>(index)};
  row.insert(row.end(), p.q.begin(), p.q.end());
  row.push_back(p.V);
  for (const int count : {p.morse_index, p.nullity, p.n_unstable, p.n_stable}) row.push_back(count);
  row.insert(row.end(), p.hessian_eigenvalues.begin(), p.hessian_eigenvalues.end());
  for (const auto& rate : p.rates) row.insert(row.end(), {rate.real(), rate.imag()});
  for (std::size_t i = 0; i < row.size(); ++i) row[i] *= scales(columns[i].unit);
  return row;
}

}  // namespace

std::vector<scene::Column> equilibria_columns(const std::vector<scene::Column>& coordinates, int n_modes) {
  std::vector<scene::Column> columns{{"index", "", "number of the point, by rising potential; its coordinates follow"}};
  columns.insert(columns.end(), coordinates.begin(), coordinates.end());
  columns.insert(
      columns.end(),
      {{"potential", "mass*length^2/time^2", "potential energy"},
       {"morse_index", "", "number of directions in which the potential falls"},
       {"nullity", "", "number of directions in which it is level to second order, those of symmetries among them"},
       {"n_unstable", "",
        "dimension of the unstable manifold under the system's own dissipation or, where it has none, under the force "
        "-(momentum)/(the scene's unit of time)"},
       {"n_stable", "", "dimension of the stable manifold, likewise"}});
  for (int k = 1; k <= n_modes; ++k)
    columns.push_back({fmt::format("hessian_{}", k), "1/time^2",
                       k > 1 ? "as for hessian_1"
                             : "least eigenvalue of the potential's second derivative in the metric of the kinetic "
                               "energy, the square of a frequency; every degree of freedom k has its hessian_k"});
  for (int k = 1; k <= 2 * n_modes; ++k) {
    columns.push_back({fmt::format("rate_{}_re", k), "1/time",
                       k > 1 ? "as for rate_1_re"
                             : "real part of a rate z: small motions of the system itself go like exp(z t), where it "
                               "has no dissipation with z^2 = -hessian_k; every degree of freedom has two rates"});
    columns.push_back(
        {fmt::format("rate_{}_im", k), "1/time", k > 1 ? "as for rate_1_im" : "imaginary part of that rate"});
  }
  return columns;
}

ModelOutcome run_equilibria(const mechanics::AnyLandscape& landscape, bool dissipative,
                            const std::vector<scene::Column>& coordinates, const systems::Scales& scales,
                            const RunContext& context) {
  // Coordinates that are not periodic are places in the system's own unit of length (systems/*_scene.h). Starts are in
  // a box of twice that; what lies outside, or on a scale of its own like a rod a thousandth as long, is found only
  // where Newton's iteration leads there: a search, as the log says.
  constexpr double radius = 2;
  mechanics::CriticalPointSearch search{.radius = radius};
  if (!dissipative) search.added_damping = [&](const Eigen::VectorXd& q) { return unit_damping(landscape, q); };
  mechanics::CriticalPoints found;
  ModelOutcome outcome;
  mechanics::Status status = mechanics::find_critical_points(landscape, search, found);
  for (mechanics::CriticalPoint& point : found.points)
    if (status && !dissipative) status = find_own_rates(landscape, point);
  if (!status) {
    outcome.end = mechanics::Outcome::failed;
    outcome.message = "the search for critical points failed: " + status.reason();
    return outcome;
  }
  const int n_modes = found.points.empty() ? 0 : static_cast<int>(found.points.front().hessian_eigenvalues.size());
  const std::vector<scene::Column> columns = equilibria_columns(coordinates, n_modes);
  std::vector<std::string> names;
  for (const scene::Column& column : columns) names.push_back(column.name);
  auto csv = io::CsvWriter::create(context.directory.csv("equilibria"), names);
  int index = 0;
  for (const mechanics::CriticalPoint& point : found.points)
    csv.append(equilibria_row(++index, point, columns, scales));
  csv.flush();
  context.log->info("{} critical points from {} of {} starts (a search: there may be more)", found.points.size(),
                    found.n_converged, found.n_starts);
  for (const mechanics::CriticalPoint& p : found.points)
    context.log->info("  V = {:.6g}: Morse index {}, nullity {}, {} unstable and {} stable directions",
                      p.V * scales("mass*length^2/time^2"), p.morse_index, p.nullity, p.n_unstable, p.n_stable);
  outcome.statistics.counters["critical_points"] = static_cast<double>(found.points.size());
  outcome.statistics.counters["starts"] = found.n_starts;
  outcome.statistics.counters["converged_starts"] = found.n_converged;
  return outcome;
}

}  // namespace pseudorigid::app
