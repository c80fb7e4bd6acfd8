#pragma once
/// Data that all models of one run share, and the outcome that the run of each model returns.

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/other_resolution.h"
#include "app/ranks/ranks.h"
#include "app/run/model_sink.h"
#include "entries/units.h"
#include "io/column_table.h"
#include "io/log.h"
#include "io/manifest.h"
#include "io/run_directory.h"
#include "io/signals.h"
#include "mechanics/core/outcome.h"
#include "mechanics/methods/methods.h"
#include "scene/needs.h"
#include "scene/scene.h"
#include "systems/system_scene.h"

namespace pseudorigid::app {

struct RunContext;

/// A function that makes the sink for the results of a model. `model` is the name of the files of the run.
using SinkOfModel = std::function<std::unique_ptr<ModelSink>(const RunContext& context, const char* model)>;

/// Data of a run that its models need. The objects to which the context refers must exist as long as the context.
struct RunContext {
  const scene::Scene& scene;
  const scene::Needs& needs;
  const io::RunDirectory& directory;
  io::Units units;  ///< internal units, measured in the user's units
  std::shared_ptr<io::Logger> log;
  SinkOfModel sink_of;               ///< makes the sink of each model
  bool resumes = false;              ///< true if the run continues an earlier run in the directory
  bool shows_progress = false;       ///< true if the run shows its completed fraction on the terminal
  const Ranks* ranks = &one_rank();  ///< processes that share the run of the model
  /// Receives the tables of `table_of`. If the pointer is null, these tables are written to files.
  std::map<std::string, io::Table>* tables = nullptr;

  /// Converts a time of the scene to internal units.
  double internal_time(double physical) const { return physical / units.time; }
  /// Factors that convert numbers of tables from internal units to the user's units.
  systems::Scales scales() const { return {units.length, units.mass, units.time}; }
  /// The time of sample k in the user's units.
  double time_of_sample(long k) const {
    return scene.time.end * (static_cast<double>(k) / static_cast<double>(scene.output.samples));
  }
  /// True if a signal that ends the run, for example SIGINT (Ctrl-C) or SIGTERM, has reached any rank. Collective.
  bool interrupted() const { return ranks->any(io::interrupt_requested()); }
};

/// A copy of the context that refers to another scene and to other needs. `scene` and `needs` must exist as long as the
/// copy.
inline RunContext derived(const RunContext& context, const scene::Scene& scene, const scene::Needs& needs) {
  const auto& [its_scene, its_needs, directory, units, log, sink_of, resumes, shows_progress, ranks, tables] = context;
  return {.scene = scene,
          .needs = needs,
          .directory = directory,
          .units = units,
          .log = log,
          .sink_of = sink_of,
          .resumes = resumes,
          .shows_progress = shows_progress,
          .ranks = ranks,
          .tables = tables};
}

/// The table of modes, Love numbers or equilibria with this name: an entry of context.tables, or a CSV file if
/// context.tables is null.
inline io::ColumnTable table_of(const RunContext& context, const std::string& name,
                                const std::vector<scene::Column>& columns) {
  if (context.tables) return {(*context.tables)[name], columns, context.scales()};
  return {context.directory.csv(name), columns, context.scales()};
}

/// Method and step of a run.
struct Stepping {
  mechanics::MethodId method;
  double step;                 ///< upper bound of the step, in internal time
  double local_tolerance = 0;  ///< tolerance per step of an adaptive method
  /// Numbers of steps in the intervals between samples, for a run that does not choose them. Empty for other runs.
  std::vector<long> n_steps{};
};

/// Result of a model's run.
struct ModelOutcome {
  mechanics::Outcome end = mechanics::Outcome::finished;
  std::string message;                 ///< one sentence for the user if the run has not finished
  io::Manifest::Model statistics;      ///< counters and timers of the run
  std::optional<Stepping> stepping{};  ///< method and step of a motion; empty for other analyses
  std::vector<long> n_steps{};         ///< of each interval between samples; empty if they were not recorded
  /// Statistics of the additional polynomial bodies of a run, by the names of their files.
  std::map<std::string, io::Manifest::Model> of_rungs{};
  /// The same motion on another discretisation, for the estimate of the error in space; empty without an estimate.
  std::optional<analysis::OtherResolution> other{};
  std::string results{};  ///< text for standard output at the end of the run
  bool is_over = false;   ///< true if a resumed run cannot continue, for example after a collision
};

/// Adds a line to the results and to log.txt. Standard output shows the results at the end of the run.
inline void add_result(ModelOutcome& outcome, const RunContext& context, const std::string& line) {
  context.log->debug("{}", line);
  outcome.results += line + "\n";
}

}  // namespace pseudorigid::app
