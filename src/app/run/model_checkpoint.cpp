#include "app/run/model_checkpoint.h"

#include <array>
#include <utility>

#include "app/run/mesh_file.h"
#include "scene/print_scene.h"
#include "scene/user_error.h"

namespace pseudorigid::app {
namespace {

/// Value in a checkpoint for a time error that is not known.
inline constexpr double unknown_error = -1;

}  // namespace

RunIdentity run_identity(const scene::Scene& scene) {
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

void add_snapshot(io::Checkpoint& c, const Snapshot& snapshot, SavedVectors vectors, const std::string& prefix) {
  const RunPosition& position = snapshot.position;
  const mechanics::Counters& n = snapshot.counters;
  const auto set = [&](const char* name, auto value) { c.set(prefix + name, std::move(value)); };
  set("sample", position.cursor.sample);
  set("step in interval", position.cursor.step);
  set("steps in interval", position.steps_in_interval);
  set("halvings", static_cast<long>(position.halvings));
  set("halvings after failure", static_cast<long>(position.halvings_after_failure));
  set("energy has changed", static_cast<long>(position.energy_has_changed));
  set("changes of energy", static_cast<long>(position.n_changes_of_energy));
  set("halvings for energy", static_cast<long>(position.halvings_for_energy));
  set("held intervals", static_cast<long>(position.n_held));
  set("repeated intervals", position.n_repeated);
  set("failed intervals", position.n_failed);
  set("repeated forces", position.n_repeated_forces);
  set("next look", position.looks.next);
  set("last look", position.looks.last);
  set("method", std::string(mechanics::method_name(position.method)));
  set("numbers",
      std::array{position.step, position.local_tolerance, position.max_constraint, position.max_constraint_rate,
                 snapshot.t, position.looks.stable_step, position.looks.fastest_change,
                 position.time_error.value_or(unknown_error), position.n_stable_steps});
  set("q", std::move(vectors.q));
  set("v", std::move(vectors.v));
  set("memory", std::move(vectors.memory));
  set("counters", std::array{static_cast<double>(n.n_steps), static_cast<double>(n.n_substeps),
                             static_cast<double>(n.n_force), static_cast<double>(n.n_position_iterations),
                             static_cast<double>(n.n_projections), static_cast<double>(n.n_gram_iterations)});
}

io::Checkpoint to_checkpoint(const RunIdentity& identity, const Snapshot& snapshot, SavedVectors vectors) {
  io::Checkpoint c;
  c.set("scene", identity.frozen_scene);
  c.set("stepping", identity.stepping);
  c.set("choice", identity.choice);
  add_snapshot(c, snapshot, std::move(vectors));
  return c;
}

void from_checkpoint(const io::Checkpoint& c, Snapshot& snapshot, const std::string& prefix) {
  const auto integer = [&](const char* name) { return c.get_integer(prefix + name); };
  const auto& numbers = c.get_doubles(prefix + "numbers", 9);
  const auto method = mechanics::find_method(c.get_string(prefix + "method"));
  if (!method) throw UserError("the checkpoint is of a method that this program does not have");
  snapshot.position = {{integer("sample"), integer("step in interval")},
                       *method,
                       numbers[0],
                       numbers[1],
                       integer("steps in interval"),
                       static_cast<int>(integer("halvings")),
                       static_cast<int>(integer("halvings after failure")),
                       integer("energy has changed") != 0,
                       static_cast<int>(integer("changes of energy")),
                       static_cast<int>(integer("halvings for energy")),
                       static_cast<int>(integer("held intervals")),
                       integer("repeated intervals"),
                       integer("failed intervals"),
                       integer("repeated forces"),
                       numbers[8],
                       {integer("next look"), integer("last look"), numbers[5], numbers[6]},
                       numbers[2],
                       numbers[3],
                       numbers[7] == unknown_error ? std::nullopt : std::optional(numbers[7])};
  snapshot.t = numbers[4];
  const auto& n = c.get_doubles(prefix + "counters", 6);
  snapshot.counters = {static_cast<long>(n[0]), static_cast<long>(n[1]), static_cast<long>(n[2]),
                       static_cast<long>(n[3]), static_cast<long>(n[4]), static_cast<long>(n[5])};
}

}  // namespace pseudorigid::app
