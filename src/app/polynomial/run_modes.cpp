#include "app/polynomial/run_modes.h"

#include <chrono>
#include <vector>

#include "app/polynomial/body_setup.h"
#include "app/run/mode_table.h"
#include "app/run/scene_to_model.h"
#include "materials/rest_moduli.h"
#include "polynomial/rest_modes.h"

namespace pseudorigid::app {

ModelOutcome run_polynomial_modes(const RunContext& context) {
  const scene::Scene& scene = context.scene;
  const auto start = std::chrono::steady_clock::now();
  const polynomial::BodySetup setup = body_setup(scene, {}, scene.polynomial.degrees.front());
  std::vector<polynomial::RestFrequency> found;
  ModelOutcome outcome;
  const mechanics::Status status = polynomial::rest_frequencies(setup, scene.body.incompressible,
                                                                static_cast<std::size_t>(scene.modes.number), found);
  auto& counters = outcome.statistics.counters;
  auto& timers = outcome.statistics.timers;
  timers["run"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  counters["degree"] = setup.degree;
  std::vector<ModeFrequency> rows;
  for (const auto& f : found)
    rows.push_back({f.omega, f.least, f.largest, f.spheroidal, f.degree, f.overtone, 2 * f.degree + 1});
  // The space of polynomials is invariant under rotations, so the frequencies of the copies of a mode differ by
  // round-off only.
  outcome.message = !status ? status.reason() : instability(rows, context.units);
  if (outcome.message.empty()) outcome.message = differing_copies(rows);
  if (!outcome.message.empty()) {
    outcome.end = mechanics::Outcome::failed;
    return outcome;
  }
  const materials::RestModuli moduli = materials::moduli_at_rest(setup.law, scene.body.incompressible);
  const double gamma = gravity_to_elasticity(scene);
  write_mode_table(rows, {moduli, scene.body.incompressible, gamma}, context, mode_file(context.needs, "polynomial"),
                   outcome);
  context.log->info("polynomial: degree {}, {} frequencies, {:.3g} s", setup.degree, found.size(), timers["run"]);
  return outcome;
}

}  // namespace pseudorigid::app
