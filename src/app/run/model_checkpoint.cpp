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

io::Checkpoint to_checkpoint(const RunIdentity& identity, const Snapshot& snapshot, SavedVectors vectors) {
  const RunPosition& position = snapshot.position;
  const mechanics::Counters& n = snapshot.counters;
  io::Checkpoint c;
  c.set("scene", identity.frozen_scene);
  c.set("stepping", identity.stepping);
  c.set("choice", identity.choice);
  c.set("sample", position.cursor.sample);
  c.set("step in interval", position.cursor.step);
  c.set("steps in interval", position.steps_in_interval);
  c.set("halvings", static_cast<long>(position.halvings));
  c.set("halvings after failure", static_cast<long>(position.halvings_after_failure));
  c.set("repeated intervals", position.n_repeated);
  c.set("failed intervals", position.n_failed);
  c.set("next look", position.looks.next);
  c.set("last look", position.looks.last);
  c.set("method", std::string(mechanics::method_name(position.method)));
  c.set("numbers", std::array{position.step, position.local_tolerance, position.max_constraint,
                              position.max_constraint_rate, snapshot.t, position.looks.stable_step,
                              position.looks.fastest_change, position.time_error.value_or(unknown_error)});
  c.set("q", std::move(vectors.q));
  c.set("v", std::move(vectors.v));
  c.set("memory", std::move(vectors.memory));
  c.set("counters", std::array{static_cast<double>(n.n_steps), static_cast<double>(n.n_substeps),
                               static_cast<double>(n.n_force), static_cast<double>(n.n_position_iterations),
                               static_cast<double>(n.n_projections), static_cast<double>(n.n_gram_iterations)});
  return c;
}

void from_checkpoint(const io::Checkpoint& c, Snapshot& snapshot) {
  const auto& numbers = c.get_doubles("numbers", 8);
  const auto method = mechanics::find_method(c.get_string("method"));
  if (!method) throw UserError("the checkpoint is of a method that this program does not have");
  snapshot.position = {{c.get_integer("sample"), c.get_integer("step in interval")},
                       *method,
                       numbers[0],
                       numbers[1],
                       c.get_integer("steps in interval"),
                       static_cast<int>(c.get_integer("halvings")),
                       static_cast<int>(c.get_integer("halvings after failure")),
                       c.get_integer("repeated intervals"),
                       c.get_integer("failed intervals"),
                       {c.get_integer("next look"), c.get_integer("last look"), numbers[5], numbers[6]},
                       numbers[2],
                       numbers[3],
                       numbers[7] == unknown_error ? std::nullopt : std::optional(numbers[7])};
  snapshot.t = numbers[4];
  const auto& n = c.get_doubles("counters", 6);
  snapshot.counters = {static_cast<long>(n[0]), static_cast<long>(n[1]), static_cast<long>(n[2]),
                       static_cast<long>(n[3]), static_cast<long>(n[4]), static_cast<long>(n[5])};
}

}  // namespace pseudorigid::app
