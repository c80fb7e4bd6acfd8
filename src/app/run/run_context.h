#pragma once
/// What all models of one run share.

#include <memory>
#include <optional>

#include "app/ranks/ranks.h"
#include "app/run/deformation_trace.h"
#include "entries/units.h"
#include "io/csv.h"
#include "io/log.h"
#include "io/manifest.h"
#include "io/run_directory.h"
#include "io/signals.h"
#include "mechanics/core/body_observables.h"
#include "mechanics/methods/methods.h"
#include "scene/discretization.h"
#include "scene/needs.h"
#include "scene/scene.h"

namespace pseudorigid::app {

/// What a run steps with.
struct KnownStepping {
  mechanics::MethodId method;
  double step;  ///< internal time, an upper bound
};

struct RunContext {
  const scene::Scene& scene;
  const scene::Needs& needs;
  const io::RunDirectory& directory;
  io::Units units;
  std::shared_ptr<io::Logger> log;
  bool resume;
  bool show_progress;
  io::Table* rows = nullptr;  ///< where the rows go instead of files, and no checkpoint is written (sweeps)
  const Ranks* ranks = &one_rank();
  scene::Discretization discretization{};   ///< of the continuum
  std::optional<KnownStepping> stepping{};  ///< found by another run of the scene, in place of a search
  DeformationTrace* trace = nullptr;        ///< where the continuum leaves Q as it goes

  /// The scene's times in internal units.
  double internal_time(double physical) const { return physical / units.time; }
  /// Whether Ctrl-C has reached any rank. Collective.
  bool interrupted() const { return ranks->any(io::interrupt_requested()); }
  /// Whether this process writes the results.
  bool writes() const { return !rows && ranks->is_first(); }
  mechanics::ObservableRequest request() const {
    const scene::Quantities& q = needs.quantities;
    return {q.energies, q.momenta, q.multiplier, q.axes, q.nonaffine, q.pressure, q.bipolar};
  }
};

/// The context of a run of the same scene with other needs or another section Time.
inline RunContext derived(const RunContext& context, const scene::Scene& scene, const scene::Needs& needs) {
  return {.scene = scene,
          .needs = needs,
          .directory = context.directory,
          .units = context.units,
          .log = context.log,
          .resume = context.resume,
          .show_progress = context.show_progress,
          .ranks = context.ranks};
}

/// How a model's run ended.
struct ModelOutcome {
  enum class State { finished, interrupted, failed } state = State::finished;
  std::string message;  ///< one sentence, for the user, if not finished
  io::Manifest::Model statistics;
  std::optional<KnownStepping> stepping{};
};

}  // namespace pseudorigid::app
