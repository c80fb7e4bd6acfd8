#include "app/run_command.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "analysis/comparison_report.h"
#include "app/ball_equilibria.h"
#include "app/discretization_search.h"
#include "app/effort.h"
#include "app/failure.h"
#include "app/model_checkpoint.h"
#include "app/on_all_ranks.h"
#include "app/run_models.h"
#include "app/scene_to_model.h"
#include "app/sweep.h"
#include "app/sweep_rows.h"
#include "io/csv.h"
#include "io/files.h"
#include "io/progress.h"
#include "io/report.h"
#include "io/signals.h"
#include "io/standard_streams.h"
#include "scene/needs.h"
#include "scene/print_scene.h"
#include "scene/scales.h"
#include "scene/user_error.h"

namespace pseudorigid::app {
namespace {

/// The samples that both models reached; a model that stopped early has fewer.
void shorten_to_common(io::Table& a, io::Table& b) {
  const std::size_t n = std::min(a.n_rows(), b.n_rows());
  a.values.resize(n * a.columns.size());
  b.values.resize(n * b.columns.size());
}

/// What the models' runs know of their errors.
void take_errors(const std::map<std::string, io::Manifest::Model>& models, analysis::ComparisonOptions& options) {
  for (const auto& [name, model] : models) {
    if (const auto e = model.counters.find("relative_space_error"); e != model.counters.end())
      options.space_error = e->second;
    if (const auto e = model.counters.find("estimated_time_error"); e != model.counters.end())
      options.time_error += e->second;
    if (const auto t = model.counters.find("surface_limit_time"); t != model.counters.end())
      options.surface_limit_time = t->second;
  }
}

/// Returns why the table could not be printed, if it could not. It is in comparison.json as well.
std::string compare_models(const RunContext& context, const io::Manifest& manifest, bool quiet) {
  io::Table reduced = io::read_csv(context.directory.csv("reduced"));
  io::Table continuum = io::read_csv(context.directory.csv("continuum"));
  shorten_to_common(reduced, continuum);
  if (reduced.n_rows() < 2) return {};
  analysis::ComparisonOptions options;
  options.resolution = context.scene.time.tolerance;
  if (context.scene.body.incompressible && scene::is_free(context.scene) && !scene::has_mesh_file(context.scene))
    options.exact_frequency_ratio = analysis::incompressible_ball_ratio;
  take_errors(manifest.models, options);
  const analysis::Comparison comparison = analysis::compare(reduced, continuum, options);
  analysis::write_comparison(context.directory.path(), comparison);
  context.log->debug("{}", analysis::summary_sentence(comparison));
  if (comparison.has_state) context.log->debug("{}", analysis::model_difference(comparison));
  try {
    if (!quiet) io::print(analysis::terminal_table(comparison));
  } catch (const io::WriteError& error) {
    return error.what();
  }
  return {};
}

/// Runs one model and notes it in the manifest. False: the run ends here.
bool run_model(const char* name, ModelOutcome (*run)(const RunContext&), const RunContext& context,
               io::ManifestFile& manifest, std::string& message, bool& interrupted) {
  ModelOutcome outcome = run(context);
  if (const auto& counters = outcome.statistics.counters; counters.contains("steps"))  // an equilibrium has none
    context.log->info("{}: {:.0f} steps{}, {:.3g} s", name, counters.at("steps"),
                      context.resume ? " in all; since the resume" : "", outcome.statistics.timers["run"]);
  manifest.content().models[name] = std::move(outcome.statistics);
  interrupted = outcome.state == ModelOutcome::State::interrupted;
  message = std::move(outcome.message);
  return outcome.state == ModelOutcome::State::finished;
}

bool is_resumable(const RunContext& context) {
  std::vector<std::string> models{"reduced", "continuum", SweepRows::name, DiscretizationSearch::checkpoint_name};
  if (const auto* system = context.needs.system) models.emplace_back(system->file);
  return std::any_of(models.begin(), models.end(),
                     [&](const std::string& model) { return exists(context.directory.checkpoint(model)); });
}

int run_models(const RunContext& context, const Executable& executable, io::ManifestFile& manifest, bool quiet) {
  std::string message;
  bool interrupted = false, complete = true;
  const scene::Needs& needs = context.needs;
  const bool equilibria = context.scene.analysis == scene::Analysis::equilibrium;
  const std::string system(needs.system ? needs.system->file : "");
  if (needs.system) complete = run_model(system.c_str(), run_system, context, manifest, message, interrupted);
  if (needs.reduced)
    complete =
        run_model("reduced", equilibria ? run_ball_equilibria : run_reduced, context, manifest, message, interrupted);
  if (complete && needs.continuum) {
    RunContext of_all = context;
    // The modes of one octant are found in one process.
    if (context.scene.analysis != scene::Analysis::modes && executable.ranks->of_first(true))
      of_all.ranks = executable.ranks;
    complete = run_model("continuum", executable.run_continuum, of_all, manifest, message, interrupted);
  }
  const bool both_exist = !needs.continuum || manifest.content().models.contains("continuum");
  std::string not_printed;
  if (needs.comparison && both_exist && !interrupted) not_printed = compare_models(context, manifest.content(), quiet);
  if (complete) {
    context.log->info("results are in {}", context.directory.path().string());
    if (!not_printed.empty()) {
      context.log->error("{}; the results are complete", not_printed);
      manifest.finish("failed", exit_stopped, not_printed);
      return exit_stopped;
    }
    manifest.finish("done", exit_done);
    return exit_done;
  }
  context.log->error("{}{}", message,
                     !is_resumable(context) ? ""
                     : interrupted          ? " (--resume goes on from there)"
                                            : " (--resume goes on from there, with a smaller Time/Step perhaps)");
  manifest.finish(interrupted ? "interrupted" : "failed", exit_stopped, message);
  return exit_stopped;
}

int run_whole_sweep(const scene::ReadScene& raw, const RunContext& context, io::ManifestFile& manifest) {
  ModelOutcome outcome = run_sweep(raw, context);
  manifest.content().models["sweep"] = std::move(outcome.statistics);
  if (outcome.state == ModelOutcome::State::finished) {
    context.log->info("results are in {}", context.directory.path().string());
    manifest.finish("done", exit_done);
    return exit_done;
  }
  if (outcome.state == ModelOutcome::State::failed) {
    context.log->error("{}", outcome.message);
    manifest.finish("failed", exit_wrong_input, outcome.message);
    return exit_wrong_input;
  }
  context.log->error("{} (--resume goes on from there)", outcome.message);
  manifest.finish("interrupted", exit_stopped, outcome.message);
  return exit_stopped;
}

io::Manifest manifest_of(const scene::Scene& scene, const scene::Needs& needs, const std::vector<std::string>& command,
                         const Executable& executable) {
  io::Manifest content{.build = io::build_info(),
                       .command = command,
                       .title = scene.title,
                       .scene = scene::summary(scene, needs),
                       .entries = scene::used_values(scene),
                       .needed = needs.needed,
                       .skipped = needs.skipped,
                       .warnings = needs.warnings,
                       .system = needs.system ? std::string(needs.system->file) : "",
                       .columns = {},
                       .libraries = executable.libraries,
                       .models = {}};
  if (needs.system)
    content.columns[content.system + ".csv"] = needs.system->columns;
  else if (scene.analysis == scene::Analysis::equilibrium)
    content.columns["equilibria.csv"] = ball_equilibria_columns();
  return content;
}

/// The last file of a run, which shows the others.
void add_report(const RunContext& context, const io::ManifestFile& manifest) {
  io::write_report(context.directory, manifest.content().system);
  context.log->info("the report is {}", context.directory.report().string());
}

/// What was thrown on the way ends the run, which says so wherever it can.
int stop(const Failure& failure, const RunContext& context, std::optional<io::ManifestFile>& manifest) {
  const bool goes_on = failure.exit_code == exit_stopped && is_resumable(context);
  context.log->error("{}{}", failure.message,
                     goes_on ? "; what was written before is kept, and --resume goes on from the last checkpoint" : "");
  try {
    if (manifest) manifest->finish("failed", failure.exit_code, failure.message);
  } catch (const io::WriteError&) {  // has been said
  }
  return failure.exit_code;
}

/// Every checkpoint in the directory can be read and belongs to this scene.
void require_same_scene(const io::RunDirectory& directory, const scene::Scene& scene) {
  std::vector<std::string> models{"reduced", "continuum", SweepRows::name, DiscretizationSearch::checkpoint_name};
  if (const auto* system = scene.catalogue->system(scene.system)) models.emplace_back(system->file);
  for (const std::string& model : models) {
    const auto path = directory.checkpoint(model);
    if (std::filesystem::exists(path) &&
        io::Checkpoint::load(path).get_string("scene") != run_identity(scene).frozen_scene)
      throw UserError("the checkpoint in " + directory.path().string() +
                      " is of another scene; only Time/Step, Time/Method and Time/Tolerance may change");
  }
}

/// Makes the directory ready. What is wrong with it is said before anything in it has changed, and of whoever named it.
io::RunLock prepare(const io::RunDirectory& directory, const scene::ReadScene& read, const Options& options) {
  constexpr const char* entry = "Output/Directory";
  try {
    std::vector<std::string> system_files;
    for (const auto& system : read.scene.catalogue->systems) system_files.push_back(std::string(system.file) + ".csv");
    io::RunLock lock = options.resume ? directory.prepare_resume() : directory.prepare_fresh(system_files);
    if (options.resume) require_same_scene(directory, read.scene);
    if (read.scene.output.graphics != scene::Graphics::none) directory.prepare_graphics();
    return lock;
  } catch (const UserError& error) {
    const std::string origin = options.resume   ? "--resume"
                               : options.output ? "--output"
                                                : read.origins.of(entry) + ": " + entry;
    throw UserError(origin + ": " + error.what());
  }
}

}  // namespace

int run_scene(const scene::ReadScene& raw, const scene::ReadScene& read, const Options& options,
              const std::vector<std::string>& command, const Executable& executable) {
  const scene::Scene& scene = read.scene;
  const scene::Needs needs = needs_with_effort(scene);
  const io::RunDirectory directory(scene.output.directory, options.scene, options.output);
  io::install_signal_handlers();
  const io::RunLock lock = prepare(directory, read, options);
  const bool quiet = options.verbosity == io::Verbosity::quiet;
  const auto log = io::make_logger(options.verbosity, directory.log(), options.resume);
  const RunContext context{
      scene, needs, directory, units_of(scene), log, options.resume, !quiet && io::Progress::stderr_is_terminal()};
  std::optional<io::ManifestFile> manifest;
  try {
    io::write_file_atomically(directory.used_prm(), {scene::to_prm(scene, read.origins)});
    manifest.emplace(directory.manifest(), manifest_of(scene, needs, command, executable));
    log->info("{}{}", read.name, scene.title.empty() ? "" : ": " + scene.title);
    log->debug("{}", scene::describe(scene, needs));
    for (const std::string& warning : needs.warnings) log->warn("{}", warning);
    const int code = scene.sweep.empty() ? run_models(context, executable, *manifest, quiet)
                                         : run_whole_sweep(raw, context, *manifest);
    if (needs.report) add_report(context, *manifest);
    return code;
  } catch (const std::exception& error) {
    return stop(failure_of(error), context, manifest);
  }
}

int assist_scene(const scene::ReadScene& read, const Options& options, const Executable& executable) {
  const scene::Scene& scene = read.scene;
  const scene::Needs needs = needs_with_effort(scene);
  const io::RunDirectory directory(scene.output.directory, options.scene, options.output);
  io::install_signal_handlers();
  RunContext context{
      scene,          needs, directory, units_of(scene), io::make_logger(io::Verbosity::silent, std::nullopt),
      options.resume, false};
  context.ranks = executable.ranks;
  int code = exit_done;
  while (executable.ranks->of_first(false)) try {
      if (executable.run_continuum(context).state != ModelOutcome::State::finished) code = exit_stopped;
    } catch (const FailureOnAllRanks& error) {
      code = error.failure().exit_code;
    }
  return code;
}

}  // namespace pseudorigid::app
