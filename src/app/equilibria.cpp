#include "app/equilibria.h"

#include <fmt/format.h>

#include <string>

#include "io/csv.h"
#include "mechanics/critical_points.h"

namespace pseudorigid::app {
namespace {

std::vector<std::string> equilibria_columns(const std::vector<scene::Column>& coordinates, int n_modes) {
  std::vector<std::string> columns{"index"};
  for (const scene::Column& coordinate : coordinates) columns.push_back(coordinate.name);
  for (const char* name : {"potential", "morse_index", "nullity", "n_unstable", "n_stable"}) columns.push_back(name);
  for (int k = 1; k <= n_modes; ++k) columns.push_back(fmt::format("hessian_{}", k));
  for (int k = 1; k <= 2 * n_modes; ++k)
    for (const char* part : {"re", "im"}) columns.push_back(fmt::format("rate_{}_{}", k, part));
  return columns;
}

std::vector<double> equilibria_row(int index, const mechanics::CriticalPoint& p,
                                   const std::vector<scene::Column>& coordinates, const systems::Scales& scales) {
  std::vector<double> row{static_cast<double>(index)};
  for (Eigen::Index i = 0; i < p.q.size(); ++i) row.push_back(p.q[i] * scales(coordinates[i].unit));
  row.push_back(p.V * scales("mass*length^2/time^2"));
  for (const int count : {p.morse_index, p.nullity, p.n_unstable, p.n_stable}) row.push_back(count);
  for (const double curvature : p.hessian_eigenvalues) row.push_back(curvature * scales("1/time^2"));
  for (const auto& rate : p.rates)
    for (const double part : {rate.real(), rate.imag()}) row.push_back(part * scales("1/time"));
  return row;
}

}  // namespace

ModelOutcome run_equilibria(const mechanics::AnyLandscape& landscape, bool dissipative,
                            const std::vector<scene::Column>& coordinates, const systems::Scales& scales,
                            const RunContext& context) {
  mechanics::CriticalPointSearch search{.radius = 2};
  if (!dissipative)
    search.added_damping = [&](const Eigen::VectorXd& q) {
      Eigen::MatrixXd M;
      landscape.mass(q, M);
      return M;
    };
  mechanics::CriticalPoints found;
  ModelOutcome outcome;
  if (mechanics::Status status = mechanics::find_critical_points(landscape, search, found); !status) {
    outcome.state = ModelOutcome::State::failed;
    outcome.message = "the search for critical points failed: " + status.reason();
    return outcome;
  }
  const int n_modes = found.points.empty() ? 0 : static_cast<int>(found.points.front().hessian_eigenvalues.size());
  auto csv = io::CsvWriter::create(context.directory.csv("equilibria"), equilibria_columns(coordinates, n_modes));
  int index = 0;
  for (const mechanics::CriticalPoint& point : found.points)
    csv.append(equilibria_row(++index, point, coordinates, scales));
  csv.flush();
  context.log->info("{} critical points from {} of {} starts", found.points.size(), found.n_converged, found.n_starts);
  for (const mechanics::CriticalPoint& p : found.points)
    context.log->info("  V = {:.6g}: Morse index {}, nullity {}, {} unstable and {} stable directions",
                      p.V * scales("mass*length^2/time^2"), p.morse_index, p.nullity, p.n_unstable, p.n_stable);
  outcome.statistics.counters["critical_points"] = static_cast<double>(found.points.size());
  outcome.statistics.counters["starts"] = found.n_starts;
  outcome.statistics.counters["converged_starts"] = found.n_converged;
  return outcome;
}

}  // namespace pseudorigid::app
