#include "app/commands/model_runs.h"

#include <algorithm>

#include "app/commands/sweep_run.h"
#include "app/run/scene_to_model.h"
#include "scene/needs.h"
#include "scene/user_error.h"

namespace pseudorigid::app {

std::string column_prefix(std::string_view run) {
  std::string name = std::string(run) + "_";
  std::ranges::replace(name, '-', '_');
  return name;
}

std::vector<std::string> first_columns(const scene::Scene& scene) {
  std::vector<std::string> names{"run"};
  for (const auto& parameter : scene.sweep) names.push_back(parameter.name);
  return names;
}

FinishedRun ModelRuns::run(int k) const {
  const scene::ParameterValues values = scene::values_of_run(raw_.scene.sweep, k);
  const scene::Scene scene = scene_of_run(raw_, values);
  const scene::Needs needs = scene::needs(scene);  // the sector and the estimates can differ between runs
  if (columns_of(scene, needs) != columns())
    throw UserError(
        "Sweep/Parameters: expected runs with the same columns of sweep.csv, got a run with other columns "
        "than the first one");
  Tables tables;
  const RunContext context{
      .scene = scene,
      .needs = needs,
      .directory = context_.directory,
      .units = units_of(scene),
      .log = silent_,
      .sink_of = [&tables](const RunContext&,
                           const char* name) { return std::make_unique<RowsInMemory>(tables[name]); },
      .tables = &tables};
  FinishedRun run{.row = {k + 1.0}, .samples = {}, .end = mechanics::Outcome::finished, .message = {}};
  for (const auto& parameter : raw_.scene.sweep) run.row.push_back(values.at(parameter.name));
  compute(context, tables, run);
  return run;
}

bool add_outcome(const ModelOutcome& outcome, mechanics::Outcome& end, std::string& message) {
  if (outcome.end == mechanics::Outcome::finished) return false;
  end = outcome.end;
  message += (message.empty() ? "" : "; ") + outcome.message;
  return end == mechanics::Outcome::interrupted;
}

}  // namespace pseudorigid::app
