#include "app/commands/linear_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>

#include "app/commands/sweep_run.h"
#include "app/run/love_table.h"
#include "app/run/mode_table.h"
#include "app/run/scene_to_model.h"
#include "scene/models.h"
#include "scene/needs.h"

namespace pseudorigid::app {
namespace {

/// A table of the analysis, and how its values become columns of sweep.csv.
struct Part {
  std::string file;                ///< name of the table without .csv
  std::string prefix;              ///< of the columns of sweep.csv
  std::vector<std::string> names;  ///< columns of the table; the first one numbers its rows
  std::vector<int> numbers;        ///< values of the first column, in the order of the columns of sweep.csv
};

std::vector<std::string> names_of(const std::vector<scene::Column>& columns) {
  std::vector<std::string> names;
  for (const scene::Column& column : columns) names.push_back(column.name);
  return names;
}

std::string prefix_of(std::string_view run_name) {
  std::string run(run_name);
  std::ranges::replace(run, '-', '_');
  return run + "_";
}

std::vector<Part> parts_of(const scene::Scene& scene, const scene::Needs& needs) {
  std::vector<Part> parts;
  std::vector<int> indices;
  for (int i = 1; i <= scene.modes.number; ++i) indices.push_back(i);
  const bool is_modes = scene.analysis == scene::Analysis::modes;
  for (const scene::ModelDescription* model : needs.models)
    if (is_modes)
      parts.push_back({mode_file(needs, model->name), prefix_of(model->name), names_of(mode_columns()), indices});
    else
      for (const scene::ModelRun& run : scene::runs_of(*model, scene))
        parts.push_back(
            {love_file(run.name), prefix_of(run.name), names_of(love_columns()), scene::love_degrees(scene)});
  return parts;
}

/// Appends the values of a table, or zeros for rows that it does not have.
void append(const Part& part, const io::Table& table, std::vector<double>& row) {
  for (const int number : part.numbers) {
    std::size_t i = 0;
    while (i < table.n_rows() && table.row(i)[0] != number) ++i;
    for (std::size_t c = 1; c < part.names.size(); ++c) row.push_back(i < table.n_rows() ? table.row(i)[c] : 0);
  }
}

}  // namespace

std::vector<std::string> columns_of_linear_runs(const scene::Scene& scene, const scene::Needs& needs) {
  std::vector<std::string> names{"run"};
  for (const auto& parameter : scene.sweep) names.push_back(parameter.name);
  names.emplace_back("finished");
  for (const Part& part : parts_of(scene, needs))
    for (const int number : part.numbers)
      for (std::size_t c = 1; c < part.names.size(); ++c)
        names.push_back(fmt::format("{}{}_{}", part.prefix, part.names[c], number));
  return names;
}

LinearRuns::LinearRuns(const scene::ReadScene& raw, const Executable& executable, const RunContext& context)
    : raw_(raw), executable_(executable), context_(context), silent_(io::make_logger(io::Verbosity::silent, {})) {}

std::vector<std::string> LinearRuns::columns() const { return columns_of_linear_runs(context_.scene, context_.needs); }

FinishedRun LinearRuns::run(int k) const {
  const scene::ParameterValues values = scene::values_of_run(raw_.scene.sweep, k);
  const scene::Scene scene = scene_of_run(raw_, values);
  const scene::Needs needs = scene::needs(scene);
  std::map<std::string, io::Table> tables;
  const RunContext context{.scene = scene,
                           .needs = needs,
                           .directory = context_.directory,
                           .units = units_of(scene),
                           .log = silent_,
                           .sink_of = {},
                           .tables = &tables};
  FinishedRun run{.row = {k + 1.0}, .samples = {}, .end = mechanics::Outcome::finished, .message = {}};
  for (const auto& parameter : raw_.scene.sweep) run.row.push_back(values.at(parameter.name));
  for (const scene::ModelDescription* model : needs.models) {
    const ModelOutcome outcome = executable_.model(*model).run(context);
    if (outcome.end == mechanics::Outcome::finished) continue;
    run.end = outcome.end;
    run.message += (run.message.empty() ? "" : "; ") + outcome.message;
    if (run.end == mechanics::Outcome::interrupted) return run;
  }
  run.row.push_back(run.end == mechanics::Outcome::finished);
  for (const Part& part : parts_of(context_.scene, context_.needs)) append(part, tables[part.file], run.row);
  return run;
}

}  // namespace pseudorigid::app
