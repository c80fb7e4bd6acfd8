#include "app/polynomial/run_modes.h"

#include <chrono>
#include <numbers>
#include <vector>

#include "app/polynomial/body_setup.h"
#include "app/run/mode_table.h"
#include "materials/eigen_tensor.h"
#include "polynomial/rest_modes.h"

namespace pseudorigid::app {
namespace {

/// Lamé's moduli at rest, from DP(Id) of a shear and of a stretch; of an incompressible body only μ means anything.
struct Moduli {
  double shear, lame;
};
Moduli moduli_at_rest(const materials::AnyLaw& law) {
  const materials::Tensor<double> Id{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, shear{{{0, 1, 0}, {1, 0, 0}, {0, 0, 0}}},
      stretch{{{1, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
  return std::visit(
      [&](const auto& known) -> Moduli {
        return {known.tangent(Id, shear)(0, 1) / 2, known.tangent(Id, stretch)(1, 1)};
      },
      law);
}

}  // namespace

ModelOutcome run_polynomial_modes(const RunContext& context) {
  const scene::Scene& scene = context.scene;
  const auto start = std::chrono::steady_clock::now();
  const polynomial::BodySetup setup = body_setup(scene, {}, scene.polynomial.degrees.front());
  std::vector<polynomial::RestFrequency> found;
  ModelOutcome outcome;
  const mechanics::Status status = polynomial::rest_frequencies(setup, scene.body.incompressible,
                                                                static_cast<std::size_t>(scene.modes.number), found);
  auto& [counters, timers] = outcome.statistics;
  timers["run"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  counters["degree"] = setup.degree;
  if (!status) {
    outcome.end = mechanics::Outcome::failed;
    outcome.message = status.reason();
    return outcome;
  }
  std::vector<ModeFrequency> rows;
  for (const auto& f : found)
    rows.push_back({f.omega, f.least, f.largest, f.spheroidal, f.degree, f.overtone, 2 * f.degree + 1});
  const auto [mu, lambda] = moduli_at_rest(setup.law);
  const double gamma = 4 * std::numbers::pi / 3 * loads::constant_forcing(setup.loads).gravity_constant / mu;
  const bool is_alone = context.needs.models.size() == 1;
  write_mode_table(rows, {mu, lambda, scene.body.incompressible, gamma}, context,
                   is_alone ? "modes" : "modes-polynomial", outcome);
  context.log->info("polynomial: degree {}, {} frequencies, {:.3g} s", setup.degree, found.size(), timers["run"]);
  return outcome;
}

}  // namespace pseudorigid::app
