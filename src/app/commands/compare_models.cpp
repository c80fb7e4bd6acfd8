#include "app/commands/compare_models.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "analysis/comparison_report.h"
#include "analysis/motion.h"
#include "io/csv.h"
#include "io/files.h"
#include "io/standard_streams.h"
#include "scene/scales.h"

namespace pseudorigid::app {
namespace {

struct Run {
  const scene::ModelDescription* model;
  std::string name;  ///< of its files
  std::string adjective;
  const io::Manifest::Model* statistics;
  io::Table table;
};

/// As the ball of a run is called, with the degree that the run has found.
std::string adjective_of(const scene::ModelRun& run, const io::Manifest::Model& statistics) {
  const auto degree = statistics.counters.find("degree");
  if (!run.finds_degree || degree == statistics.counters.end()) return run.adjective;
  return fmt::format("{} N = {}", run.adjective, degree->second);
}

/// Those of which there is a file, with the samples that all of them reached; a model that stopped early has fewer.
std::vector<Run> runs_to_compare(const RunContext& context, const io::Manifest& manifest) {
  std::vector<Run> runs;
  for (const scene::ModelDescription* model : context.needs.models)
    for (const scene::ModelRun& run : scene::runs_of(*model, context.scene))
      if (const auto ran = manifest.models.find(run.name); ran != manifest.models.end())
        runs.push_back({model, run.name, adjective_of(run, ran->second), &ran->second,
                        io::read_csv(context.directory.csv(run.name))});
  std::size_t n_common = runs.empty() ? 0 : runs.front().table.n_rows();
  for (const Run& run : runs) n_common = std::min(n_common, run.table.n_rows());
  for (Run& run : runs) run.table.values.resize(n_common * run.table.columns.size());
  return n_common < 2 ? std::vector<Run>{} : runs;
}

/// What the models' runs know of their errors.
void take_errors(const io::Manifest::Model& model, analysis::ComparisonOptions& options) {
  if (const auto e = model.counters.find("relative_space_error"); e != model.counters.end())
    options.space_error = e->second;
  if (const auto e = model.counters.find("estimated_time_error"); e != model.counters.end())
    options.time_error += e->second;
  if (const auto t = model.counters.find("surface_limit_time"); t != model.counters.end())
    options.surface_limit_time = t->second;
}

analysis::Comparison compare(const RunContext& context, const Run& run, const Run& reference) {
  const scene::Scene& scene = context.scene;
  analysis::ComparisonOptions options;
  options.resolution = scene.time.tolerance;
  const bool is_free_ball = scene.body.incompressible && scene::is_free(scene) && !scene::has_mesh_file(scene);
  // The exact value is that of nine unknowns beside all: the first model and one with elements.
  if (is_free_ball && run.model == &scene.catalogue->models.front() && reference.model->discretized)
    options.exact_frequency_ratio = analysis::incompressible_ball_ratio;
  take_errors(*run.statistics, options);
  take_errors(*reference.statistics, options);
  const auto named = [](const Run& r) { return analysis::ModelRunTable{r.name, r.adjective, r.table}; };
  return analysis::compare(named(run), named(reference), options);
}

}  // namespace

std::string summarize_run(const RunContext& context) {
  const bool is_system = context.needs.system != nullptr;
  if (!is_system && context.needs.models.size() != 1) return {};
  const std::string name(is_system ? context.needs.system->file : context.needs.models.front()->name);
  const auto path = context.directory.csv(name);
  if (!io::is_there(path)) return {};
  const io::Table table = io::read_csv(path);
  if (table.n_rows() < 2) return {};
  const analysis::ModelRunTable run{
      name, is_system ? name : scene::runs_of(*context.needs.models.front(), context.scene).back().adjective, table};
  try {
    io::print(analysis::terminal_table(is_system ? analysis::summarize_system(run)
                                                 : analysis::summarize_motion(run, context.scene.time.tolerance)));
  } catch (const io::WriteError& error) {
    return error.what();
  }
  return {};
}

std::string compare_models(const RunContext& context, const io::Manifest& manifest, bool quiet) {
  const std::vector<Run> runs = runs_to_compare(context, manifest);
  if (runs.size() < 2) return {};
  const std::filesystem::path& folder = context.directory.path();
  const bool is_pair = runs.size() == 2;
  std::vector<analysis::Comparison> comparisons;
  for (std::size_t i = 0; i + 1 < runs.size(); ++i) {
    comparisons.push_back(compare(context, runs[i], runs.back()));
    const analysis::Comparison& comparison = comparisons.back();
    analysis::write_comparison(folder, is_pair ? "comparison" : "comparison-" + runs[i].name, comparison);
    context.log->debug("{}", analysis::summary_sentence(comparison));
    if (comparison.has_state) context.log->debug("{}", analysis::model_difference(comparison));
  }
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
