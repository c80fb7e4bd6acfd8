#pragma once
/// Data shared by all models of one run.

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "analysis/other_resolution.h"
#include "app/ranks/ranks.h"
#include "app/run/model_sink.h"
#include "entries/units.h"
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

/// Makes the sink of the model of that name.
using SinkOfModel = std::function<std::unique_ptr<ModelSink>(const RunContext& context, const char* model)>;

struct RunContext {
  const scene::Scene& scene;
  const scene::Needs& needs;
  const io::RunDirectory& directory;
  io::Units units;
  std::shared_ptr<io::Logger> log;
  SinkOfModel sink_of;
  bool resumes = false;  ///< continues an earlier run in the directory
  const Ranks* ranks = &one_rank();

  /// The scene's times in internal units.
  double internal_time(double physical) const { return physical / units.time; }
  /// The factors by which the columns of tables come into the user's units.
  systems::Scales scales() const { return {units.length, units.mass, units.time}; }
  double time_of_sample(long k) const {
    return scene.time.end * (static_cast<double>(k) / static_cast<double>(scene.output.samples));
  }
  /// Whether Ctrl-C has reached any rank. Collective.
  bool interrupted() const { return ranks->any(io::interrupt_requested()); }
};

/// The context of a run of the same scene with other needs or another section Time.
inline RunContext derived(const RunContext& context, const scene::Scene& scene, const scene::Needs& needs) {
  const auto& [its_scene, its_needs, directory, units, log, sink_of, resumes, ranks] = context;
  return {.scene = scene,
          .needs = needs,
          .directory = directory,
          .units = units,
          .log = log,
          .sink_of = sink_of,
          .resumes = resumes,
          .ranks = ranks};
}

/// Method and step of a run.
struct Stepping {
  mechanics::MethodId method;
  double step;  ///< internal time, an upper bound
};

/// How a model's run ended.
struct ModelOutcome {
  mechanics::Outcome end = mechanics::Outcome::finished;
  std::string message;  ///< one sentence, for the user, if not finished
  io::Manifest::Model statistics;
  std::optional<Stepping> stepping{};
  std::map<std::string, io::Manifest::Model> of_rungs{};  ///< statistics of further runs, by the names of their files
  std::optional<analysis::OtherResolution>
      other{};            ///< the same motion on another discretisation, for the error in space
  std::string results{};  ///< lines for people, for standard output
};

/// A line of results: for standard output at the end of the run, and into log.txt.
inline void add_result(ModelOutcome& outcome, const RunContext& context, const std::string& line) {
  context.log->debug("{}", line);
  outcome.results += line + "\n";
}

}  // namespace pseudorigid::app
