#include "app/commands/table_runs.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/figures/figure_families.h"
#include "app/run/love_table.h"
#include "app/run/mode_table.h"
#include "scene/models.h"

namespace pseudorigid::app {
namespace {

/// A row of a model's table whose values become a part of a row of sweep.csv.
struct WantedRow {
  std::string suffix;                             ///< end of the names of its columns in sweep.csv
  std::vector<std::pair<std::string, int>> keys;  ///< columns of the table that identify this row, with their values
};

/// A table of a model, and the columns of sweep.csv that receive its values.
struct Part {
  std::string file;                ///< name of the table without .csv
  std::string prefix;              ///< beginning of the names of the columns of sweep.csv
  std::vector<std::string> names;  ///< columns of the table
  std::size_t first;            ///< first column whose values sweep.csv receives; the columns before it identify a row
  std::vector<WantedRow> rows;  ///< in the order of sweep.csv
  bool is_flagged = false;      ///< true if a column `finished` precedes the values: 1 if the table has the row
};

std::vector<std::string> names_of(const std::vector<scene::Column>& columns) {
  std::vector<std::string> names;
  for (const scene::Column& column : columns) names.push_back(column.name);
  return names;
}

/// The part for a table whose first column has the numbers of its rows. sweep.csv receives the rows with `numbers`.
Part numbered_part(std::string file, const std::string& run, const std::vector<scene::Column>& columns,
                   const std::vector<int>& numbers) {
  Part part{std::move(file), column_prefix(run), names_of(columns), 1, {}, false};
  for (const int number : numbers) part.rows.push_back({fmt::format("_{}", number), {{part.names[0], number}}});
  return part;
}

/// The part for the table of equilibria of a model, for the model's run number k. If the model has several runs, each
/// run has a different degree. In a sweep the family has one member, so the table has no special points between
/// members.
Part equilibrium_part(const scene::ModelDescription& model, const scene::Scene& scene, std::size_t k) {
  const std::vector<scene::ModelRun> runs = scene::runs_of(model, scene);
  Part part{
      std::string(model.equilibria.file), column_prefix(runs[k].name), names_of(model.equilibria.columns), 0, {}, true};
  if (model.has_nonaffine)
    std::erase_if(part.names, [&](const std::string& name) { return !has_figure_column(scene, name); });
  part.first = static_cast<std::size_t>(std::ranges::find(part.names, "kind") - part.names.begin()) + 1;
  WantedRow row{"", {{"kind", 0}}};
  if (runs.size() > 1) row.keys.emplace_back("degree", scene.polynomial.degrees[k]);
  part.rows.push_back(std::move(row));
  return part;
}

/// The parts of all models, in the order of sweep.csv.
std::vector<Part> parts_of(const scene::Scene& scene, const scene::Needs& needs) {
  std::vector<Part> parts;
  std::vector<int> indices;
  for (int i = 1; i <= scene.modes.number; ++i) indices.push_back(i);
  for (const scene::ModelDescription* model : needs.models) {
    const std::vector<scene::ModelRun> runs = scene::runs_of(*model, scene);
    if (scene.analysis == scene::Analysis::modes)
      parts.push_back(numbered_part(mode_file(needs, model->name), std::string(model->name), mode_columns(), indices));
    else
      for (std::size_t k = 0; k < runs.size(); ++k)
        parts.push_back(
            scene.analysis == scene::Analysis::equilibrium
                ? equilibrium_part(*model, scene, k)
                : numbered_part(love_file(runs[k].name), runs[k].name, love_columns(), scene::love_degrees(scene)));
  }
  return parts;
}

/// True if row i of the table has the values that identify `wanted`.
bool has_keys(const Part& part, const WantedRow& wanted, const io::Table& table, std::size_t i) {
  return std::ranges::all_of(wanted.keys, [&](const auto& key) {
    return table.row(i)[std::ranges::find(part.names, key.first) - part.names.begin()] == key.second;
  });
}

/// Appends the values of a table to a row of sweep.csv, in the order of part.rows. If the table lacks a row, appends
/// zeros.
void append(const Part& part, const io::Table& table, std::vector<double>& row) {
  for (const WantedRow& wanted : part.rows) {
    std::size_t i = 0;
    while (i < table.n_rows() && !has_keys(part, wanted, table, i)) ++i;
    if (part.is_flagged) row.push_back(i < table.n_rows());
    for (std::size_t c = part.first; c < part.names.size(); ++c)
      row.push_back(i < table.n_rows() ? table.row(i)[c] : 0);
  }
}

}  // namespace

bool sweeps_tables(const scene::Scene& scene) {
  return scene.system == scene::ball &&
         (scene::is_linear(scene.analysis) || scene.analysis == scene::Analysis::equilibrium);
}

std::vector<std::string> columns_of_table_runs(const scene::Scene& scene, const scene::Needs& needs) {
  std::vector<std::string> names = first_columns(scene);
  names.emplace_back("finished");
  for (const Part& part : parts_of(scene, needs))
    for (const WantedRow& wanted : part.rows) {
      if (part.is_flagged) names.push_back(part.prefix + "finished");
      for (std::size_t c = part.first; c < part.names.size(); ++c)
        names.push_back(part.prefix + part.names[c] + wanted.suffix);
    }
  return names;
}

void TableRuns::compute(const RunContext& context, Tables& tables, FinishedRun& run) const {
  for (const scene::ModelDescription* model : context.needs.models)
    if (add_outcome(executable_.model(*model).run(context), run.end, run.message)) return;
  run.row.push_back(run.end == mechanics::Outcome::finished);
  for (const Part& part : parts_of(context.scene, context.needs)) append(part, tables[part.file], run.row);
}

}  // namespace pseudorigid::app
