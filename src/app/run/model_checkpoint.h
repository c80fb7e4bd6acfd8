#pragma once
/// The state of a model's run as a checkpoint, and back. In addition to (t, q, v) it holds the memory that the method
/// carries from step to step (mechanics/core/memory.h), so that a resumed run repeats the uninterrupted one.

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/run/mesh_file.h"
#include "io/checkpoint.h"
#include "mechanics/core/memory.h"
#include "mechanics/methods/methods.h"
#include "mechanics/methods/time_loop.h"
#include "scene/print_scene.h"
#include "scene/user_error.h"

namespace pseudorigid::app {

/// Estimated largest frequency of small motions about the motion, which limits the step size.
struct LooksAtFrequency {
  long next = 0, last = 0;    ///< samples
  double stable_step = 0;     ///< of RATTLE at the last look, without reserve; 0: there was none
  double fastest_change = 0;  ///< of ln(stable_step) from sample to sample, over the looks so far
};

/// Position of a run in time, and its method and step.
struct RunPosition {
  mechanics::Cursor cursor;
  mechanics::MethodId method = mechanics::id_of<mechanics::Rattle>;
  double step = 0;                      ///< upper bound of the outer step, internal time
  double local_tolerance = 0;           ///< of an adaptive method
  mechanics::Stretch stretch{0, 1, 0};  ///< that the cursor is in; no steps: it stands at a sample
  LooksAtFrequency looks{};
  double max_constraint = 0, max_constraint_rate = 0;  ///< scaled |g|, |Gv| over the samples so far
  /// Estimated for the configuration, of all the parts of the run whose step was looked for; absent if one was not.
  std::optional<double> time_error = 0;
};

/// `frozen_scene`: what a resumed run must have in common with this one, but for what commands/resume.h admits;
/// `stepping`: what decides on method and step, which are chosen anew if it has changed. If the step is given a
/// later end changes neither. `choice`: what decides on the method alone.
struct RunIdentity {
  std::string frozen_scene, stepping, choice;
};

/// The scene without the entries that a resumed run may change (step, method, tolerance, where results go), as text.
inline RunIdentity run_identity(const scene::Scene& scene) {
  scene::Scene frozen = scene, stepping, choice;
  stepping.time = choice.time = scene.time;
  choice.time.step.reset();
  choice.time.end = scene::Scene::Time{}.end;
  if (scene.time.step) stepping.time.end = choice.time.end;
  frozen.time = scene::Scene::Time{};
  frozen.time.end = scene.time.end;
  frozen.continuum.mesh = mesh_identity(scene);
  frozen.output.directory.assign(1, '-');  // g++ 12 warns of an overflow if a literal is assigned
  frozen.sweep_threads.reset();
  frozen.title.clear();
  return {scene::to_prm(frozen), scene::to_prm(stepping), scene::to_prm(choice)};
}

/// All that a run needs to go on, taken at one instant; cheap enough to be taken at every sample.
template <class S>
struct Snapshot {
  RunPosition position;
  mechanics::State<S> state;
  std::vector<double> memory;  ///< of the method
  mechanics::Counters counters;

  template <class Workspace>
  void take(const RunPosition& at, const mechanics::State<S>& s, Workspace& w) {
    position = at;
    state = s;
    mechanics::save_memory(w, memory);
    counters = w.counters;
  }
};

/// The vectors of a snapshot, whole if they are distributed.
struct SavedVectors {
  std::vector<double> q, v, memory;
};

/// In place of an estimated error in a checkpoint.
inline constexpr double unknown_error = -1;

template <class S>
io::Checkpoint to_checkpoint(const RunIdentity& identity, const Snapshot<S>& snapshot, SavedVectors vectors) {
  const RunPosition& position = snapshot.position;
  const mechanics::Counters& n = snapshot.counters;
  io::Checkpoint c;
  c.set("scene", identity.frozen_scene);
  c.set("stepping", identity.stepping);
  c.set("choice", identity.choice);
  c.set("sample", position.cursor.sample);
  c.set("step in interval", position.cursor.step);
  c.set("steps in interval", position.stretch.n_steps);
  c.set("first sample of the steps", position.stretch.first);
  c.set("last sample of the steps", position.stretch.last);
  c.set("next look", position.looks.next);
  c.set("last look", position.looks.last);
  c.set("method", std::string(mechanics::method_name(position.method)));
  c.set("numbers", std::array{position.step, position.local_tolerance, position.max_constraint,
                              position.max_constraint_rate, snapshot.state.t, position.looks.stable_step,
                              position.looks.fastest_change, position.time_error.value_or(unknown_error)});
  c.set("q", std::move(vectors.q));
  c.set("v", std::move(vectors.v));
  c.set("memory", std::move(vectors.memory));
  c.set("counters", std::array{static_cast<double>(n.n_steps), static_cast<double>(n.n_substeps),
                               static_cast<double>(n.n_force), static_cast<double>(n.n_position_iterations),
                               static_cast<double>(n.n_projections), static_cast<double>(n.n_gram_iterations)});
  return c;
}

/// A run that stands at the very start takes sample 0 again.
inline long n_samples_taken(const mechanics::Cursor& at) { return at.sample == 0 && at.step == 0 ? 0 : at.sample + 1; }
inline long n_samples_taken(const io::Checkpoint& c) {
  return n_samples_taken({c.get_integer("sample"), c.get_integer("step in interval")});
}

/// The reverse, without the vectors. UserError if the file does not fit.
template <class S>
void from_checkpoint(const io::Checkpoint& c, Snapshot<S>& snapshot) {
  const auto& numbers = c.get_doubles("numbers", 8);
  const auto method = mechanics::find_method(c.get_string("method"));
  if (!method) throw UserError("the checkpoint is of a method that this program does not have");
  snapshot.position = {{c.get_integer("sample"), c.get_integer("step in interval")},
                       *method,
                       numbers[0],
                       numbers[1],
                       {c.get_integer("first sample of the steps"), c.get_integer("last sample of the steps"),
                        c.get_integer("steps in interval")},
                       {c.get_integer("next look"), c.get_integer("last look"), numbers[5], numbers[6]},
                       numbers[2],
                       numbers[3],
                       numbers[7] == unknown_error ? std::nullopt : std::optional(numbers[7])};
  snapshot.state.t = numbers[4];
  const auto& n = c.get_doubles("counters", 6);
  snapshot.counters = {static_cast<long>(n[0]), static_cast<long>(n[1]), static_cast<long>(n[2]),
                       static_cast<long>(n[3]), static_cast<long>(n[4]), static_cast<long>(n[5])};
}

}  // namespace pseudorigid::app
