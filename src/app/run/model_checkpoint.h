#pragma once
/// Conversion between the state of a model's run and a checkpoint. The state consists of the time t, the positions q,
/// the velocities v, and the memory of the method. The memory contains the numbers that the method stores from step to
/// step (mechanics/core/memory.h). With this memory, a resumed run gives the results of the uninterrupted run.

#include <optional>
#include <string>
#include <vector>

#include "io/checkpoint.h"
#include "mechanics/core/memory.h"
#include "mechanics/methods/methods.h"
#include "mechanics/methods/time_loop.h"
#include "scene/scene.h"

namespace pseudorigid::app {

/// Record of the checks of the largest frequency of small vibrations about the motion. This frequency limits the step.
struct LooksAtFrequency {
  long next = 0, last = 0;  ///< sample of the next and of the last check
  double stable_step =
      0;  ///< stability limit of RATTLE's step at the last check, in internal time; 0 before the first check
  double fastest_change = 0;  ///< largest |change of ln(stable_step)| per sample between two checks
};

/// The position of a run in time, and the method and step of the run.
struct RunPosition {
  mechanics::Cursor cursor;
  mechanics::MethodId method = mechanics::id_of<mechanics::Rattle>;
  double step = 0;             ///< upper bound of the step in internal time, before it is halved
  double local_tolerance = 0;  ///< tolerance per step of an adaptive method
  long steps_in_interval = 0;  ///< planned number of steps from the last sample to the next; 0 at a sample
  int halvings = 0;            ///< the steps in the present interval, or in the last one, are at most step / 2^halvings
  int halvings_after_failure = 0;   ///< least number of halvings after a failed step; decreases by one per interval
  bool energy_has_changed = false;  ///< true if the energy changed in an attempt to integrate the present interval
  int n_changes_of_energy = 0;      ///< number of successive intervals before this one in which it changed
  int halvings_for_energy = 0;      ///< least number of halvings because of these changes
  int n_held = 0;                   ///< number of intervals before halvings_for_energy decreases
  long n_repeated = 0;         ///< number of attempts to integrate an interval that were repeated with shorter steps
  long n_failed = 0;           ///< number of these attempts in which a step failed
  long n_repeated_forces = 0;  ///< force evaluations of the attempts that were repeated
  /// Number of steps that RATTLE would make at its stability limit along the motion. It is counted only if intervals
  /// can be repeated.
  double n_stable_steps = 0;
  LooksAtFrequency looks{};
  /// Largest entries of |g| and |Gv| at the samples, divided by RunnableModelOf::constraint_scale. The constraints are
  /// g(q) = 0, with the derivative G = Dg.
  double max_constraint = 0, max_constraint_rate = 0;
  /// Estimated time error of the configuration at the end of the run. If a resumed run has chosen a new step, the error
  /// is the sum over the parts of the run with different steps. Empty if the program did not find the step of each part
  /// by a search with an error estimate, and in violent motions (search/time_error.h).
  std::optional<double> time_error = 0;
};

/// Entries of a scene as texts, which a resumed run compares with the texts of its own scene. `frozen_scene` has the
/// entries that must be equal, and some of the entries that may differ (`may_change` in commands/resume.cpp).
/// `stepping` has the entries that determine method and step. If one of these entries changes, the program chooses
/// method and step again. The end of the run is such an entry only if the scene does not give the step. `choice` has
/// the entries of `stepping` except the step and the end. If the entries of `choice` are equal, a run can use its
/// present method and a shorter step.
struct RunIdentity {
  std::string frozen_scene, stepping, choice;
};

/// Returns the three texts of this scene.
RunIdentity run_identity(const scene::Scene& scene);

/// The data at one time that a run needs to continue, in addition to q and v.
struct Snapshot {
  RunPosition position{};
  double t = 0;                  ///< internal time
  std::vector<double> memory{};  ///< memory of the method
  mechanics::Counters counters{};

  /// Copies the position `at`, the time, and the memory and the counters of the method's workspace.
  template <class Workspace>
  void take(const RunPosition& at, double time, Workspace& w) {
    position = at;
    t = time;
    mechanics::save_memory(w, memory);
    counters = w.counters;
  }
};

/// The vectors of a snapshot. On the first rank, they have all entries even if the model distributes its vectors over
/// the ranks.
struct SavedVectors {
  std::vector<double> q, v, memory;
};

/// The prefix of the entries of a second snapshot in a checkpoint. If the run stopped within an interval between
/// samples, this snapshot is that of the last sample. The resumed run can then integrate the whole interval again.
inline constexpr const char* at_last_sample = "last sample: ";

/// Adds the entries of a snapshot and of its vectors to the checkpoint. The names of the entries begin with `prefix`.
void add_snapshot(io::Checkpoint& c, const Snapshot& snapshot, SavedVectors vectors, const std::string& prefix = "");
/// The checkpoint of a run, with the texts of its scene and one snapshot.
io::Checkpoint to_checkpoint(const RunIdentity& identity, const Snapshot& snapshot, SavedVectors vectors);
/// True if the checkpoint also contains the snapshot of the last sample.
inline bool has_last_sample(const io::Checkpoint& c) { return c.has(std::string(at_last_sample) + "q"); }
/// Sets all members of the snapshot except `memory`, from the entries whose names begin with `prefix`. Throws UserError
/// if the program lacks the method of the checkpoint, or if an entry is missing or has the wrong type or size.
void from_checkpoint(const io::Checkpoint& c, Snapshot& snapshot, const std::string& prefix = "");

/// Number of rows in the table of samples that a resumed run retains. The number is 0 for a checkpoint at the start:
/// the resumed run then writes sample 0 again.
inline long n_samples_taken(const mechanics::Cursor& at) { return at.sample == 0 && at.step == 0 ? 0 : at.sample + 1; }
inline long n_samples_taken(const io::Checkpoint& c) {
  return n_samples_taken({c.get_integer("sample"), c.get_integer("step in interval")});
}

}  // namespace pseudorigid::app
