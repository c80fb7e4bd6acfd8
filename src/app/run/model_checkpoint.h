#pragma once
/// The state of a model's run as a checkpoint, and back. In addition to (t, q, v) it holds the memory that the method
/// carries from step to step (mechanics/core/memory.h), so that a resumed run repeats the uninterrupted one.

#include <optional>
#include <string>
#include <vector>

#include "io/checkpoint.h"
#include "mechanics/core/memory.h"
#include "mechanics/methods/methods.h"
#include "mechanics/methods/time_loop.h"
#include "scene/scene.h"

namespace pseudorigid::app {

/// Estimated largest frequency of small motions about the motion, which limits the step size.
struct LooksAtFrequency {
  long next = 0, last = 0;    ///< samples
  double stable_step = 0;     ///< stable step of RATTLE at the last check, without reserve; 0 before the first check
  double fastest_change = 0;  ///< rate of ln(stable_step) from sample to sample, over the checks so far
};

/// Position of a run in time, and its method and step.
struct RunPosition {
  mechanics::Cursor cursor;
  mechanics::MethodId method = mechanics::id_of<mechanics::Rattle>;
  double step = 0;             ///< upper bound of the outer step, internal time
  double local_tolerance = 0;  ///< of an adaptive method
  long steps_in_interval = 0;  ///< steps done in the interval of the cursor; 0 at a sample
  LooksAtFrequency looks{};
  double max_constraint = 0, max_constraint_rate = 0;  ///< scaled |g|, |Gv| over the samples so far
  /// Estimated error of the configuration over all parts of the run whose step was searched; absent if one of them has
  /// no estimate.
  std::optional<double> time_error = 0;
};

/// `frozen_scene`: the entries that a resumed run must share with this one, except those that commands/resume.h admits.
/// `stepping`: the entries that decide method and step, which are chosen again if they change. If the step is given, a
/// later end changes neither. `choice`: the entries that decide the method alone.
struct RunIdentity {
  std::string frozen_scene, stepping, choice;
};

/// The scene without the entries that a resumed run may change (step, method, tolerance, where results go), as text.
RunIdentity run_identity(const scene::Scene& scene);

/// The data at one instant that a run needs to continue, in addition to q and v.
struct Snapshot {
  RunPosition position{};
  double t = 0;
  std::vector<double> memory{};  ///< of the method
  mechanics::Counters counters{};

  template <class Workspace>
  void take(const RunPosition& at, double time, Workspace& w) {
    position = at;
    t = time;
    mechanics::save_memory(w, memory);
    counters = w.counters;
  }
};

/// The vectors of a snapshot, whole if they are distributed.
struct SavedVectors {
  std::vector<double> q, v, memory;
};

io::Checkpoint to_checkpoint(const RunIdentity& identity, const Snapshot& snapshot, SavedVectors vectors);
/// The reverse, without the vectors. UserError if the file does not fit.
void from_checkpoint(const io::Checkpoint& c, Snapshot& snapshot);

/// A run whose checkpoint is at the start takes sample 0 again.
inline long n_samples_taken(const mechanics::Cursor& at) { return at.sample == 0 && at.step == 0 ? 0 : at.sample + 1; }
inline long n_samples_taken(const io::Checkpoint& c) {
  return n_samples_taken({c.get_integer("sample"), c.get_integer("step in interval")});
}

}  // namespace pseudorigid::app
