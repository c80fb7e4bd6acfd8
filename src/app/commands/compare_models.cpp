#include "app/commands/compare_models.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "analysis/comparison_report.h"
#include "analysis/motion.h"
#include "app/run/small_pulsation.h"
#include "io/csv.h"
#include "io/files.h"
#include "io/standard_streams.h"
#include "scene/scales.h"

namespace pseudorigid::app {
namespace {

/// Reads the tables of all runs that have an entry in the manifest. A run that ended before its first row has no table.
std::vector<RunOfModel> runs_with_files(const RunContext& context, const io::Manifest& manifest) {
  std::vector<RunOfModel> runs;
  for (const scene::ModelDescription* model : context.needs.models)
    for (const scene::ModelRun& run : scene::runs_of(*model, context.scene))
      if (const auto ran = manifest.models.find(run.name);
          ran != manifest.models.end() && io::is_there(context.directory.csv(run.name)))
        runs.push_back({model, run.name, adjective_of(run, ran->second), ran->second,
                        io::read_csv(context.directory.csv(run.name))});
  return runs;
}

/// Truncates all tables to the samples that every run has, because a model that stopped early has fewer samples.
/// Removes all runs if fewer than two samples remain.
void truncate_to_common_samples(std::vector<RunOfModel>& runs) {
  std::size_t n_common = runs.empty() ? 0 : runs.front().table.n_rows();
  for (const RunOfModel& run : runs) n_common = std::min(n_common, run.table.n_rows());
  for (RunOfModel& run : runs) run.table.values.resize(n_common * run.table.columns.size());
  if (n_common < 2) runs.clear();
}

/// The counter of a run with this name; empty if the run does not have it.
std::optional<double> counter(const io::Manifest::Model& statistics, const char* name) {
  const auto found = statistics.counters.find(name);
  return found == statistics.counters.end() ? std::nullopt : std::optional(found->second);
}

/// The errors that a run of `model` has estimated, and the motion of the model on another discretisation. An error is
/// empty if the run has not estimated it. The error in space, which is relative to |Q|, and the quadrature error of the
/// pseudo-rigid body are 0. The quadrature error of finite elements is 0 as well, because their error in space contains
/// it.
analysis::RunErrors errors_of(const scene::ModelDescription& model, const io::Manifest::Model& statistics,
                              const OtherResolutions& others) {
  const auto other = others.find(model.name);
  return {
      .time = counter(statistics, "estimated_time_error"),
      .space = model.has_nonaffine ? counter(statistics, "relative_space_error") : 0,
      .quadrature = model.has_nonaffine && !model.discretized ? counter(statistics, "estimated_quadrature_error") : 0,
      .other = other == others.end() ? nullptr : &other->second};
}

/// Number of attempts to integrate an interval between samples in which a step failed; 0 if they were not counted.
long n_failed_intervals(const io::Manifest::Model& statistics) {
  return static_cast<long>(counter(statistics, "failed_intervals").value_or(0));
}

/// Logs a warning if the energy of a model changes by more than its bound (analysis/motion.h).
void warn_of_energy(const RunContext& context, const analysis::ModelSummary& summary) {
  if (const std::string clause = analysis::energy_clause(summary); !clause.empty())
    context.log->warn("{}; a smaller Time/Step or Time/Tolerance keeps it better", clause);
}

/// The data of the scene that the summary of a motion needs.
analysis::SceneFacts facts_of(const RunContext& context) {
  const scene::Scene& scene = context.scene;
  return {.resolution = scene.time.tolerance,
          .energy_unit = context.units.energy(),
          .stress_unit = context.units.stress(),
          .tolerance = scene.time.step ? std::nullopt : std::optional(scene.time.tolerance),
          .load_frequencies = loads::angular_frequencies(scene.loads),
          .loads_rise = scene::loads_rise(scene),
          .is_free = scene::is_free(scene),
          .incompressible = scene.body.incompressible};
}

/// Compares a run with the reference, which is the last run.
analysis::Comparison compare(const RunContext& context, const RunOfModel& run, const RunOfModel& reference,
                             const OtherResolutions& others) {
  const scene::Scene& scene = context.scene;
  analysis::ComparisonOptions options{.facts = facts_of(context)};
  // Two conditions restrict the exact ratio of the frequencies. The pseudo-rigid model must be compared with the
  // finite-element model. The ball must be incompressible, because a compressible ball can oscillate mainly in its
  // volume.
  if (const auto small = small_pulsation(scene);
      small && scene.body.incompressible && !run.model->has_nonaffine && reference.model->discretized)
    options.exact_frequency_ratio = small->ratio();
  options.surface_limit_time = counter(reference.statistics, "surface_limit_time");
  const auto named = [&](const RunOfModel& r) {
    return analysis::ModelRunTable{r.name, r.adjective, r.table, errors_of(*r.model, r.statistics, others),
                                   n_failed_intervals(r.statistics)};
  };
  return analysis::compare(named(run), named(reference), options);
}

}  // namespace

std::string adjective_of(const scene::ModelRun& run, const io::Manifest::Model& statistics) {
  const auto degree = statistics.counters.find("degree");
  if (!run.finds_degree || degree == statistics.counters.end()) return run.adjective;
  return fmt::format("{} N = {}", run.adjective, degree->second);
}

std::vector<analysis::Comparison> comparisons_of(const RunContext& context, std::vector<RunOfModel> runs,
                                                 const OtherResolutions& others) {
  truncate_to_common_samples(runs);
  std::vector<analysis::Comparison> comparisons;
  for (std::size_t i = 0; i + 1 < runs.size(); ++i)
    comparisons.push_back(compare(context, runs[i], runs.back(), others));
  return comparisons;
}

std::string summarize_run(const RunContext& context, const io::Manifest& manifest, const OtherResolutions& others) {
  const bool is_system = context.needs.system != nullptr;
  if (!is_system && context.needs.models.size() != 1) return {};
  const std::string name(is_system ? context.needs.system->file : context.needs.models.front()->name);
  const auto path = context.directory.csv(name);
  if (!io::is_there(path)) return {};
  const io::Table table = io::read_csv(path);
  if (table.n_rows() < 2) return {};
  analysis::ModelRunTable run{name, name, table};
  if (!is_system) {
    const scene::ModelDescription& model = *context.needs.models.front();
    run.adjective = scene::runs_of(model, context.scene).back().adjective;
    run.errors = errors_of(model, manifest.models.at(name), others);
    run.n_failed_intervals = n_failed_intervals(manifest.models.at(name));
  }
  const auto summary = is_system ? analysis::summarize_system(run) : analysis::summarize_motion(run, facts_of(context));
  warn_of_energy(context, summary.model);
  try {
    io::print(analysis::terminal_table(summary));
  } catch (const io::WriteError& error) {
    return error.what();
  }
  return {};
}

std::string compare_models(const RunContext& context, const io::Manifest& manifest, const OtherResolutions& others,
                           bool quiet) {
  const std::vector<analysis::Comparison> comparisons =
      comparisons_of(context, runs_with_files(context, manifest), others);
  if (comparisons.empty()) return {};
  const std::filesystem::path& folder = context.directory.path();
  const bool is_pair = comparisons.size() == 1;
  for (const analysis::Comparison& comparison : comparisons) {
    analysis::write_comparison(folder, is_pair ? "comparison" : "comparison-" + comparison.model.name, comparison);
    warn_of_energy(context, comparison.model);
    context.log->debug("{}", analysis::summary_sentence(comparison));
    if (comparison.has_state) context.log->debug("{}", analysis::model_difference(comparison));
    if (comparison.ratio) context.log->debug("{}", analysis::frequency_ratio(comparison));
  }
  warn_of_energy(context, comparisons.back().reference);
  if (!is_pair)
    io::write_file_atomically(context.directory.comparison_json(),
                              {analysis::overview_json(comparisons).dump(2), "\n"});
  try {
    if (!quiet) io::print(is_pair ? analysis::terminal_table(comparisons.front()) : analysis::overview(comparisons));
  } catch (const io::WriteError& error) {
    return error.what();
  }
  return {};
}

}  // namespace pseudorigid::app
