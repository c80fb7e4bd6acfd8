#include "app/commands/linear_runs.h"

#include <fmt/format.h>

#include "app/run/love_table.h"
#include "app/run/mode_table.h"
#include "scene/models.h"

namespace pseudorigid::app {
namespace {

/// A table of modes or Love numbers, and the columns of sweep.csv that receive its values.
struct Part {
  std::string file;                ///< name of the table without .csv
  std::string prefix;              ///< beginning of the names of the columns of sweep.csv
  std::vector<std::string> names;  ///< columns of the table; the first one has the numbers of the rows
  std::vector<int> numbers;        ///< numbers of the rows that sweep.csv receives, in its order
};

std::vector<std::string> names_of(const std::vector<scene::Column>& columns) {
  std::vector<std::string> names;
  for (const scene::Column& column : columns) names.push_back(column.name);
  return names;
}

std::vector<Part> parts_of(const scene::Scene& scene, const scene::Needs& needs) {
  std::vector<Part> parts;
  std::vector<int> indices;
  for (int i = 1; i <= scene.modes.number; ++i) indices.push_back(i);
  const bool is_modes = scene.analysis == scene::Analysis::modes;
  for (const scene::ModelDescription* model : needs.models)
    if (is_modes)
      parts.push_back({mode_file(needs, model->name), column_prefix(model->name), names_of(mode_columns()), indices});
    else
      for (const scene::ModelRun& run : scene::runs_of(*model, scene))
        parts.push_back(
            {love_file(run.name), column_prefix(run.name), names_of(love_columns()), scene::love_degrees(scene)});
  return parts;
}

/// Appends the values of a table to a row of sweep.csv, in the order of part.numbers. If the table lacks a row, appends
/// zeros.
void append(const Part& part, const io::Table& table, std::vector<double>& row) {
  for (const int number : part.numbers) {
    std::size_t i = 0;
    while (i < table.n_rows() && table.row(i)[0] != number) ++i;
    for (std::size_t c = 1; c < part.names.size(); ++c) row.push_back(i < table.n_rows() ? table.row(i)[c] : 0);
  }
}

}  // namespace

std::vector<std::string> columns_of_linear_runs(const scene::Scene& scene, const scene::Needs& needs) {
  std::vector<std::string> names = first_columns(scene);
  names.emplace_back("finished");
  for (const Part& part : parts_of(scene, needs))
    for (const int number : part.numbers)
      for (std::size_t c = 1; c < part.names.size(); ++c)
        names.push_back(fmt::format("{}{}_{}", part.prefix, part.names[c], number));
  return names;
}

void LinearRuns::compute(const RunContext& context, Tables& tables, FinishedRun& run) const {
  for (const scene::ModelDescription* model : context.needs.models)
    if (add_outcome(executable_.model(*model).run(context), run.end, run.message)) return;
  run.row.push_back(run.end == mechanics::Outcome::finished);
  for (const Part& part : parts_of(context.scene, context.needs)) append(part, tables[part.file], run.row);
}

}  // namespace pseudorigid::app
