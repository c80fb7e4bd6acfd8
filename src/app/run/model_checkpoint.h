#pragma once
/// Conversion of the state of a model's run to a checkpoint and back. The state consists of (t, q, v) and of the memory
/// that the method carries from step to step (mechanics/core/memory.h). With this memory, a resumed run repeats the
/// uninterrupted one.

#include <optional>
#include <string>
#include <vector>

#include "io/checkpoint.h"
#include "mechanics/core/memory.h"
#include "mechanics/methods/methods.h"
#include "mechanics/methods/time_loop.h"
#include "scene/scene.h"

namespace pseudorigid::app {

/// Record of the checks of the largest frequency of small perturbations of the motion. This frequency limits the step.
struct LooksAtFrequency {
  long next = 0, last = 0;    ///< sample of the next check and of the last one
  double stable_step = 0;     ///< stable step of RATTLE at the last check, without safety factor; 0: no check
  double fastest_change = 0;  ///< largest change of |ln(stable_step)| per sample between two checks
};

/// Position of a run in time, and its method and step.
struct RunPosition {
  mechanics::Cursor cursor;
  mechanics::MethodId method = mechanics::id_of<mechanics::Rattle>;
  double step = 0;             ///< upper bound of the step in internal time; a method can divide a step
  double local_tolerance = 0;  ///< tolerance of an adaptive method per step
  long steps_in_interval = 0;  ///< number of steps in the present interval between samples; 0 at a sample
  LooksAtFrequency looks{};
  double max_constraint = 0, max_constraint_rate = 0;  ///< largest scaled |g| and |Gv| at the samples so far
  /// Estimated error of the configuration, the sum over all parts of the run. Absent if the step of a part was not
  /// found by a search with an error estimate.
  std::optional<double> time_error = 0;
};

/// Entries of a scene as text, which a resumed run compares with its own. `frozen_scene` has the entries that must be
/// equal, except for changes that commands/resume.h admits. `stepping` has the entries that determine method and step:
/// if one changes, the program chooses both again. If the scene gives the step, the end of the run does not affect this
/// choice. `choice` has the entries that determine the method alone.
struct RunIdentity {
  std::string frozen_scene, stepping, choice;
};

/// The texts of this scene.
RunIdentity run_identity(const scene::Scene& scene);

/// The data at one instant that a run needs to continue, in addition to q and v.
struct Snapshot {
  RunPosition position{};
  double t = 0;
  std::vector<double> memory{};  ///< memory of the method
  mechanics::Counters counters{};

  template <class Workspace>
  void take(const RunPosition& at, double time, Workspace& w) {
    position = at;
    t = time;
    mechanics::save_memory(w, memory);
    counters = w.counters;
  }
};

/// The vectors of a snapshot: whole vectors, also if the model distributes them over ranks.
struct SavedVectors {
  std::vector<double> q, v, memory;
};

io::Checkpoint to_checkpoint(const RunIdentity& identity, const Snapshot& snapshot, SavedVectors vectors);
/// Restores the snapshot without the vectors. Throws UserError if the file does not fit.
void from_checkpoint(const io::Checkpoint& c, Snapshot& snapshot);

/// Number of samples already written. A run whose checkpoint is at the start writes sample 0 again.
inline long n_samples_taken(const mechanics::Cursor& at) { return at.sample == 0 && at.step == 0 ? 0 : at.sample + 1; }
inline long n_samples_taken(const io::Checkpoint& c) {
  return n_samples_taken({c.get_integer("sample"), c.get_integer("step in interval")});
}

}  // namespace pseudorigid::app
