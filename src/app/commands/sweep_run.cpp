#include "app/commands/sweep_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "analysis/motion.h"
#include "app/commands/kept_trajectories.h"
#include "app/commands/scene_to_run.h"
#include "app/run/scene_to_model.h"
#include "entries/entry_kinds.h"
#include "scene/needs.h"
#include "scene/user_error.h"
#include "scene/validate.h"

namespace pseudorigid::app {
namespace {

/// The columns of sweep.csv that directly follow the parameters, for every model and system.
constexpr std::array<const char*, 5> columns_of_any{"finished", "time", "steps", "forces", "estimated_time_error"};
constexpr std::array<const char*, 2> names_of_frequencies{"frequency", "amplitude"};

bool has_frequencies(const scene::Needs& needs) { return !needs.system && needs.quantities.state; }

/// Names of the columns of the ball that the motion conserves in every run. Only the runs of `corners`, with the first
/// or last values of the parameters, are examined. The set is empty for systems other than the ball.
std::set<std::string> conserved_columns(const scene::ReadScene& raw) {
  bool is_free = true, incompressible = true;
  for (const int k : corners(raw.scene.sweep)) {
    const scene::Scene scene = scene::validate(
        scene::with_parameters(raw.scene, scene::values_of_run(raw.scene.sweep, k), raw.origins), raw.origins);
    if (scene.system != scene::ball) return {};
    is_free = is_free && scene::is_free(scene);
    incompressible = incompressible && scene.body.incompressible;
  }
  return names_conserved(is_free, incompressible);
}

}  // namespace

std::string describe_values(const scene::ParameterValues& values) {
  std::string text;
  for (const auto& [name, value] : values)
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", name, scene::print_number(value));
  return text;
}

scene::Scene scene_of_run(const scene::ReadScene& raw, const scene::ParameterValues& values) {
  return scene_to_run(scene::with_parameters(raw.scene, values, raw.origins), raw.origins);
}

std::set<int> corners(const scene::Sweep& sweep) {
  std::set<int> runs{0};
  const auto vary = [&runs](int size) {
    std::set<int> with_this_one;
    for (const int k : runs)
      for (const int i : {0, size - 1}) with_this_one.insert(k * size + i);
    runs = std::move(with_this_one);
  };
  for (const scene::SweepParameter& parameter : sweep)
    if (!parameter.seed) vary(parameter.size());
  vary(scene::n_latin(sweep));
  return runs;
}

std::set<std::string> names_conserved(bool is_free, bool incompressible) {
  std::set<std::string> names{"energy"};  // the energy includes the energies of loads and dissipation
  if (is_free) names.insert({"J1", "J2", "J3", "Z1", "Z2", "Z3"});
  if (incompressible) names.insert("volume_ratio");
  return names;
}

std::vector<std::string> columns_of_frequencies() { return {names_of_frequencies.begin(), names_of_frequencies.end()}; }

std::vector<std::string> columns_of_sweep(const scene::Scene& scene, const scene::Needs& needs,
                                          const std::set<std::string>& conserved) {
  const std::vector<std::string> of_model = columns_of_run(scene, needs);
  std::vector<std::string> names{"run"};
  for (const auto& parameter : scene.sweep) names.push_back(parameter.name);
  names.insert(names.end(), columns_of_any.begin(), columns_of_any.end());
  if (has_frequencies(needs)) names.insert(names.end(), names_of_frequencies.begin(), names_of_frequencies.end());
  for (std::size_t i = 1; i < of_model.size(); ++i)
    if (conserved.contains(of_model[i]))
      names.insert(names.end(), {of_model[i], of_model[i] + "_drift"});
    else
      for (const char* what : {"end", "min", "max"}) names.push_back(of_model[i] + "_" + what);
  return names;
}

SweepRun::SweepRun(const scene::ReadScene& raw, RunModel run, RunTogether together, const RunContext& context)
    : raw_(raw),
      run_(run),
      together_(raw.scene.sweep_lanes ? together : nullptr),
      context_(context),
      conserved_(conserved_columns(raw)),
      silent_(io::make_logger(io::Verbosity::silent, {})) {}

FinishedRun SweepRun::run(int k) const {
  Result result;
  const scene::Scene scene = scene_of_run(raw_, scene::values_of_run(raw_.scene.sweep, k));
  result.outcome = run_(context_of(scene, result));
  return finished(k, std::move(result));
}

FinishedRun SweepRun::finished(int k, Result result) const {
  return {.row = row(k, result),
          .samples = raw_.scene.sweep_trajectories ? std::move(result.rows) : io::Table{},
          .end = result.outcome.end,
          .message = std::move(result.outcome.message)};
}

std::optional<std::vector<FinishedRun>> SweepRun::run_together(int first, int last) const {
  if (!together_) return {};
  std::vector<Result> results(static_cast<std::size_t>(last - first));
  std::vector<scene::Scene> scenes;
  try {
    for (int k = first; k < last; ++k) scenes.push_back(scene_of_run(raw_, scene::values_of_run(raw_.scene.sweep, k)));
  } catch (const UserError&) {  // the single run reports the error later, with the number of the run
    return {};
  }
  std::vector<RunContext> contexts;
  for (std::size_t i = 0; i < scenes.size(); ++i) contexts.push_back(context_of(scenes[i], results[i]));
  auto outcomes = together_(contexts);
  if (!outcomes) return {};
  std::vector<FinishedRun> runs;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    results[i].outcome = std::move((*outcomes)[i]);
    runs.push_back(finished(first + static_cast<int>(i), std::move(results[i])));
  }
  return runs;
}

std::vector<double> SweepRun::row(int k, const Result& result) const {
  std::vector<double> row{k + 1.0};
  const scene::ParameterValues values = scene::values_of_run(raw_.scene.sweep, k);
  for (const auto& parameter : raw_.scene.sweep) row.push_back(values.at(parameter.name));
  const io::Table& table = result.rows;
  const std::size_t n = table.n_rows();
  row.push_back(result.outcome.end == mechanics::Outcome::finished);
  row.push_back(n > 0 ? table.row(n - 1)[0] : 0);
  const auto& counters = result.outcome.statistics.counters;
  for (const char* name : {"steps", "forces", "estimated_time_error"}) {
    const auto found = counters.find(name);
    row.push_back(found != counters.end() ? found->second : 0);
  }
  if (has_frequencies(context_.needs)) add_frequency(table, row);
  for (std::size_t c = 1; c < table.columns.size(); ++c) {
    double least = n > 0 ? table.row(0)[c] : 0, most = least;
    for (std::size_t i = 1; i < n; ++i) {
      least = std::min(least, table.row(i)[c]);
      most = std::max(most, table.row(i)[c]);
    }
    if (conserved_.contains(table.columns[c]))
      row.insert(row.end(), {n > 0 ? table.row(0)[c] : 0, most - least});
    else
      row.insert(row.end(), {n > 0 ? table.row(n - 1)[c] : 0, least, most});
  }
  return row;
}

RunContext SweepRun::context_of(const scene::Scene& scene, Result& result) const {
  return {.scene = scene,
          .needs = context_.needs,
          .directory = context_.directory,
          .units = units_of(scene),
          .log = silent_,
          .sink_of = [&result](const RunContext&, const char*) { return std::make_unique<RowsInMemory>(result.rows); }};
}

void SweepRun::add_frequency(const io::Table& table, std::vector<double>& row) const {
  analysis::ModelSummary model;
  if (table.n_rows() > 1)
    model = analysis::summarize_motion({"", "", table}, {.resolution = context_.scene.time.tolerance}).model;
  row.push_back(model.frequency ? model.frequency.dominant().frequency : 0);
  row.push_back(model.strain_amplitude);
}

}  // namespace pseudorigid::app
