#include "app/commands/run_command.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "app/commands/compare_models.h"
#include "app/commands/disk_use.h"
#include "app/commands/files_of_run.h"
#include "app/commands/resume.h"
#include "app/commands/sweep.h"
#include "app/ranks/failure.h"
#include "app/ranks/on_all_ranks.h"
#include "app/run/love_table.h"
#include "app/run/mode_table.h"
#include "app/run/model_files.h"
#include "app/run/run_models.h"
#include "app/run/scene_to_model.h"
#include "app/search/effort.h"
#include "io/csv.h"
#include "io/files.h"
#include "io/progress.h"
#include "io/report.h"
#include "io/standard_streams.h"
#include "scene/needs.h"
#include "scene/print_scene.h"
#include "scene/scales.h"
#include "scene/user_error.h"

namespace pseudorigid::app {
namespace {

/// Runs one model or system, and writes the statistics of its runs into the manifest. `name` is the name of the files
/// of the last run.
ModelOutcome run_model(std::string_view name, RunModel run, const RunContext& context, io::ManifestFile& manifest) {
  ModelOutcome outcome = run(context);
  if (const auto& counters = outcome.statistics.counters; counters.contains("steps"))  // equilibria do not have steps
    context.log->info("{}: {:.0f} steps{}, {:.3g} s", name, counters.at("steps"),
                      context.resumes ? " in all; since the resume" : "", outcome.statistics.timers["run"]);
  manifest.content().models[std::string(name)] = outcome.statistics;
  for (const auto& [rung, statistics] : outcome.of_rungs) manifest.content().models[rung] = statistics;
  return outcome;
}

/// True if the directory has a checkpoint, from which --resume can continue.
bool is_resumable(const RunContext& context) { return !checkpoints(context.directory, context.scene).empty(); }

/// The context in which a model runs. All ranks compute with finite elements together. The collective call
/// of_first(true) starts the model on the ranks that wait in assist_scene.
RunContext context_of(const scene::ModelDescription& model, const RunContext& context, const Executable& executable) {
  RunContext of_model = context;
  if (model.discretized && executable.ranks->of_first(true)) of_model.ranks = executable.ranks;
  return of_model;
}

/// Prints the results. Returns the reason if printing fails, otherwise an empty string.
std::string print(const std::string& results) try {
  if (!results.empty()) io::print(results);
  return {};
} catch (const io::WriteError& error) {
  return error.what();
}

/// Writes the end of the run into the log, and the outcome into the manifest. For a finished run, the line of the log
/// has the results directory. Otherwise it has `message` followed by `advice`. Returns `exit_code`.
int end_run(mechanics::Outcome outcome, int exit_code, const std::string& message, const char* advice,
            const RunContext& context, io::ManifestFile& manifest) {
  if (outcome == mechanics::Outcome::finished)
    context.log->info("results are in {}", context.directory.path().string());
  else
    context.log->error("{}{}", message, advice);
  manifest.finish(outcome, exit_code, message);
  return exit_code;
}

/// Runs the system or the models, compares the models, and prints the results unless `quiet` is true. If a model does
/// not finish, the later models do not run. After a failure of a model, the existing samples are still compared. A run
/// whose results cannot be printed counts as failed. Returns the exit code.
int run_models(const RunContext& context, const Executable& executable, io::ManifestFile& manifest, bool quiet) {
  using enum mechanics::Outcome;
  ModelOutcome last;
  OtherResolutions others;
  std::string results;
  const auto run = [&](std::string_view name, RunModel model, const RunContext& of_model) {
    last = run_model(name, model, of_model, manifest);
    results += last.results;
    if (last.other) others.emplace(name, std::move(*last.other));
  };
  if (const auto* system = context.needs.system) run(system->file, run_system, context);
  for (const scene::ModelDescription* model : context.needs.models)
    if (last.end == finished) run(model->name, executable.model(*model).run, context_of(*model, context, executable));
  std::string not_printed = quiet ? "" : print(results);
  if (context.needs.comparison && last.end != interrupted)
    not_printed = compare_models(context, manifest.content(), others, quiet);
  else if (context.scene.analysis == scene::Analysis::motion && last.end == finished && !quiet)
    not_printed = summarize_run(context, manifest.content(), others);
  if (last.end == finished && !not_printed.empty()) {
    context.log->info("results are in {}", context.directory.path().string());
    return end_run(failed, exit_stopped, not_printed, "; the results are complete", context, manifest);
  }
  const char* advice = !is_resumable(context) || last.is_over ? ""
                       : last.end == interrupted              ? " (--resume goes on from there)"
                                                 : " (--resume goes on from there, with a smaller Time/Step perhaps)";
  return end_run(last.end, exit_code_of(last.end), last.message, advice, context, manifest);
}

/// Runs the sweep and returns the exit code.
int run_whole_sweep(const scene::ReadScene& raw, const RunContext& context, const Executable& executable,
                    io::ManifestFile& manifest) {
  using enum mechanics::Outcome;
  const ModelOutcome sweep = run_sweep(raw, context, executable);
  manifest.content().models["sweep"] = sweep.statistics;
  // The outcome of a sweep is `failed` only if the input of one of its runs is wrong.
  const int exit_code = sweep.end == failed ? exit_wrong_input : exit_code_of(sweep.end);
  return end_run(sweep.end, exit_code, sweep.message, sweep.end == interrupted ? " (--resume goes on from there)" : "",
                 context, manifest);
}

/// The columns of a model's file with their units and texts, for the manifest. In the documentation, one line can
/// describe a range of columns such as "Q11 ... Q33", so this function repeats the line for each column.
std::vector<scene::Column> columns_of(const scene::ModelDescription& model, const scene::Quantities& quantities) {
  const auto stem = [](std::string_view name) { return name.substr(0, name.find_first_of("0123456789")); };
  std::vector<scene::Column> columns;
  for (const std::string& name : model.header(quantities))
    for (const scene::Column& documented : model.columns) {
      const bool is_range = documented.name.find(" ... ") != std::string::npos;
      if (name != documented.name && !(is_range && stem(name) == stem(documented.name))) continue;
      columns.push_back({name, documented.unit, documented.documentation});
      break;
    }
  return columns;
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
                       .units = {},
                       .libraries = executable.libraries,
                       .instructions = std::string(executable.instructions()),
                       .ball = {},
                       .models = {}};
  if (needs.system)
    content.columns[content.system + ".csv"] = needs.system->columns;
  else if (scene::finds_static_equilibria(scene))
    for (const scene::ModelDescription* model : needs.models) {
      const scene::EquilibriaTable table = model->static_equilibria(scene.body.incompressible ? 8 : 9);
      content.columns[std::string(table.file) + ".csv"] = table.columns;
    }
  else if (scene.analysis == scene::Analysis::equilibrium)
    for (const scene::ModelDescription* model : needs.models)
      content.columns[std::string(model->equilibria.file) + ".csv"] = model->equilibria.columns;
  else if (scene.analysis == scene::Analysis::modes)
    for (const scene::ModelDescription* model : needs.models)
      content.columns[mode_file(needs, model->name) + ".csv"] = mode_columns();
  else if (scene.analysis == scene::Analysis::love_numbers)
    for (const scene::ModelDescription* model : needs.models)
      for (const scene::ModelRun& run : scene::runs_of(*model, scene))
        content.columns["love-" + run.name + ".csv"] = love_columns();
  else
    for (const scene::ModelDescription* model : needs.models)
      for (const scene::ModelRun& run : scene::runs_of(*model, scene))
        content.columns[run.name + ".csv"] = columns_of(*model, needs.quantities);
  for (const scene::ModelDescription* model : needs.models)
    for (const scene::ModelRun& run : scene::runs_of(*model, scene))
      content.ball.push_back({run, model->discretized, !model->has_nonaffine});
  if (!needs.system) content.units = units_of(scene);
  return content;
}

/// Writes report.html from the other files of the run. A caller must have written these files and the outcome in the
/// manifest before.
void add_report(const RunContext& context) {
  io::write_report(context.directory, io::movers_in(context.directory.manifest()));
  context.log->info("the report is {}", context.directory.report().string());
}

/// Ends the run after an exception. Records the message in the log and the manifest, and returns the exit code.
int stop(const Failure& failure, const RunContext& context, std::optional<io::ManifestFile>& manifest) {
  const bool goes_on = failure.exit_code == exit_stopped && is_resumable(context);
  context.log->error("{}{}", failure.message,
                     goes_on ? "; what was written before is kept, and --resume goes on from the last checkpoint" : "");
  try {
    if (manifest) manifest->finish(mechanics::Outcome::failed, failure.exit_code, failure.message);
  } catch (
      const io::WriteError&) {  // ignored: the log already has failure.message, which the manifest would have repeated
  }
  return failure.exit_code;
}

/// Prepares the directory and returns its lock. Throws UserError if the directory cannot be used. Examples are a lock
/// of another run, a pipe with the name of a result, and a checkpoint that does not fit the scene. The message names
/// the entry or option that determines the directory. Throws io::WriteError if the lock cannot be written.
io::RunLock prepare(const io::RunDirectory& directory, const scene::ReadScene& read, const scene::Needs& needs,
                    const Options& options) {
  constexpr const char* entry = "Output/Directory";
  try {
    const bool has_graphics = read.scene.output.graphics != scene::Graphics::none;
    if (has_graphics) directory.require_place_for_graphics();  // before earlier results are removed
    const std::vector<std::string> names = movers(*read.scene.catalogue);
    io::RunLock lock = options.resume ? directory.prepare_resume(names) : directory.prepare_fresh(names);
    if (options.resume) {
      require_same_scene(directory, read.scene);
      require_sound_files(directory, read.scene, needs);
    }
    if (has_graphics) directory.prepare_graphics();
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
  const io::RunDirectory directory(scene.output.directory, options.scene, options.output);
  scene::Needs needs = needs_with_effort(scene);
  describe_disk_use(scene, directory, needs);
  needs.gammas = gammas_of_sweep(raw);
  needs.warnings.insert(needs.warnings.begin(), read.warnings.begin(), read.warnings.end());
  const io::RunLock lock = prepare(directory, read, needs, options);
  const bool quiet = options.verbosity == io::Verbosity::quiet;
  const auto log = io::make_logger(options.verbosity, directory.log(), options.resume);
  const RunContext context{.scene = scene,
                           .needs = needs,
                           .directory = directory,
                           .units = units_of(scene),
                           .log = log,
                           .sink_of = files_of_models(),
                           .resumes = options.resume,
                           .shows_progress = !quiet && io::Progress::stderr_is_terminal()};
  std::optional<io::ManifestFile> manifest;
  try {
    io::write_file_atomically(directory.used_prm(), {scene::to_prm(scene, read.origins)});
    manifest.emplace(directory.manifest(), manifest_of(scene, needs, command, executable));
    log->info("{}{}", read.name, scene.title.empty() ? "" : ": " + scene.title);
    log->debug("{}", scene::describe(scene, needs));
    for (const std::string& warning : needs.warnings) log->warn("{}", warning);
    if (scene.output.samples != raw.scene.output.samples)
      log->info("the run goes on to Time/End = {:.6g}; Output/Samples = {}, so that they keep their distance",
                scene.time.end, scene.output.samples);
    const int code = scene.sweep.empty() ? run_models(context, executable, *manifest, quiet)
                                         : run_whole_sweep(raw, context, executable, *manifest);
    if (needs.report) add_report(context);
    return code;
  } catch (const std::exception& error) {
    return stop(failure_of(error), context, manifest);
  }
}

int assist_scene(const scene::ReadScene& read, const Options& options, const Executable& executable) {
  const scene::Scene& scene = read.scene;
  const scene::Needs needs = needs_with_effort(scene);
  const io::RunDirectory directory(scene.output.directory, options.scene, options.output);
  std::map<std::string, io::Table> unused;  // the first rank writes the tables of analyses
  const RunContext context{.scene = scene,
                           .needs = needs,
                           .directory = directory,
                           .units = units_of(scene),
                           .log = io::make_logger(io::Verbosity::silent, std::nullopt),
                           .sink_of = files_of_models(),
                           .resumes = options.resume,
                           .ranks = executable.ranks,
                           .tables = &unused};
  int code = exit_done;
  auto model = std::ranges::find_if(needs.models, &scene::ModelDescription::discretized);
  while (executable.ranks->of_first(false)) try {
      if (executable.model(**model).run(context).end != mechanics::Outcome::finished) code = exit_stopped;
      model = std::find_if(model + 1, needs.models.end(), [](const auto* next) { return next->discretized; });
    } catch (const FailureOnAllRanks& error) {
      code = error.failure().exit_code;
    }
  return code;
}

}  // namespace pseudorigid::app
