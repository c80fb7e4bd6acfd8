#include "app/systems/equilibria.h"

#include <string>

#include "app/run/critical_point_rows.h"
#include "io/column_table.h"
#include "mechanics/equilibria/critical_points.h"

namespace pseudorigid::app {
namespace {

/// The row of a critical point in internal units, in the order of equilibria_columns().
std::vector<double> equilibria_row(int index, const mechanics::CriticalPoint& p) {
  std::vector<double> row{static_cast<double>(index)};
  row.insert(row.end(), p.q.begin(), p.q.end());
  row.push_back(p.V);
  append_critical_point(p, row);
  return row;
}

}  // namespace

std::vector<scene::Column> equilibria_columns(const std::vector<scene::Column>& coordinates, int n_modes) {
  std::vector<scene::Column> columns{{"index", "", "number of the point, by rising potential; its coordinates follow"}};
  columns.insert(columns.end(), coordinates.begin(), coordinates.end());
  columns.push_back({"potential", "mass*length^2/time^2", "potential energy"});
  for (const scene::Column& column : critical_point_columns(n_modes)) columns.push_back(column);
  return columns;
}

ModelOutcome run_equilibria(const mechanics::AnyLandscape& landscape, bool dissipative,
                            const std::vector<scene::Column>& coordinates, const systems::Scales& scales,
                            const RunContext& context, mechanics::CriticalPoints* points) {
  // Coordinates that are not periodic are lengths in the system's own unit (systems/*_scene.h). The search starts at
  // points whose coordinates are at most twice this unit. Critical points outside this region, or at distances much
  // smaller than the unit, are found only if Newton's iteration leads there. The text in the log therefore calls the
  // result a search.
  constexpr double radius = 2;
  mechanics::CriticalPoints found;
  ModelOutcome outcome;
  if (const mechanics::Status status = mechanics::find_equilibria(landscape, dissipative, {.radius = radius}, found);
      !status) {
    outcome.end = mechanics::Outcome::failed;
    outcome.message = "the search for critical points failed: " + status.reason();
    return outcome;
  }
  const int n_modes = found.points.empty() ? 0 : static_cast<int>(found.points.front().hessian_eigenvalues.size());
  io::ColumnTable table(context.directory.csv("equilibria"), equilibria_columns(coordinates, n_modes), scales);
  int index = 0;
  for (const mechanics::CriticalPoint& point : found.points) table.append(equilibria_row(++index, point));
  table.flush();
  if (points) *points = found;
  report_search(found, scales("mass*length^2/time^2"), context, outcome);
  return outcome;
}

}  // namespace pseudorigid::app
