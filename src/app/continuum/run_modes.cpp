#include "app/continuum/run_modes.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "app/continuum/stored_energy.h"
#include "continuum/modes/modes.h"
#include "continuum/modes/sphere_frequencies.h"
#include "continuum/output/nodal_fields.h"
#include "io/csv.h"
#include "io/pvd.h"
#include "io/vtu.h"

namespace pseudorigid::app {
namespace {

using continuum::BallFrequency, continuum::ModeKind;
using Clock = std::chrono::steady_clock;

/// γ = ρgr/μ, g = (4/3)πGρr.
double gravity_of(const continuum::RestProblem& problem) {
  return problem.gravity ? 4 * std::numbers::pi / 3 * problem.gravity->constant() / problem.elasticity.shear_modulus()
                         : 0;
}

/// The frequency of the sphere.
double exact_frequency(const BallFrequency& f, const continuum::RestProblem& problem) {
  const double mu = problem.elasticity.shear_modulus(), lambda = problem.elasticity.lame_lambda();
  const bool spheroidal = f.kind == ModeKind::spheroidal;
  return std::sqrt(mu) * (problem.incompressible
                              ? continuum::sphere_frequency(spheroidal, f.degree, f.overtone, gravity_of(problem))
                              : continuum::compressible_sphere_frequency(spheroidal, f.degree, f.overtone,
                                                                         std::sqrt(mu / (lambda + 2 * mu))));
}

/// The pseudo-rigid ball has the five motions Q = Id + εH with H symmetric and without trace, m̄ Ḧ = −(2 + 4γ/25)μ Vol
/// H, and where it is compressible H = Id, m̄ Ḧ = −(3λ + 2μ) Vol H; Vol/m̄ = 5/(ρr²).
double reduced_frequency(const BallFrequency& f, const continuum::RestProblem& problem) {
  if (f.kind != ModeKind::spheroidal || f.overtone != 0) return 0;
  const double mu = problem.elasticity.shear_modulus(), lambda = problem.elasticity.lame_lambda();
  if (f.degree == 2) return std::sqrt((10 + 0.8 * gravity_of(problem)) * mu);
  return f.degree == 0 ? std::sqrt(5 * (3 * lambda + 2 * mu)) : 0;
}

std::string name_of(const BallFrequency& f) {
  return fmt::format("{}{}{}", f.kind == ModeKind::spheroidal ? 'S' : 'T', f.degree,
                     f.overtone == 0 ? "" : fmt::format(", overtone {}", f.overtone));
}

void write_table(const std::vector<BallFrequency>& frequencies, const continuum::RestProblem& problem,
                 const RunContext& context) {
  const std::vector<std::string> columns{"index",        "omega",  "kind",  "degree", "overtone",
                                         "multiplicity", "spread", "exact", "reduced"};
  auto csv = io::CsvWriter::create(context.directory.csv("modes"), columns);
  context.log->info("{:>3}  {:<14} {:>16} {:>6} {:>9} {:>16} {:>10} {:>16}", "", "mode", "omega", "copies", "spread",
                    "exact sphere", "difference", "pseudo-rigid");
  int index = 0;
  for (const BallFrequency& f : frequencies) {
    const double time = context.units.time, spread = (f.largest - f.least) / f.omega;
    const double exact = exact_frequency(f, problem), reduced = reduced_frequency(f, problem);
    csv.append(std::vector<double>{static_cast<double>(++index), f.omega / time, static_cast<double>(f.kind),
                                   static_cast<double>(f.degree), static_cast<double>(f.overtone),
                                   static_cast<double>(f.multiplicity), spread, exact / time, reduced / time});
    context.log->info("{:>3}  {:<14} {:>16.10g} {:>6} {:>9.1e} {:>16} {:>10} {:>16}", index, name_of(f), f.omega / time,
                      f.multiplicity, spread, fmt::format("{:.10g}", exact / time),
                      fmt::format("{:.1e}", f.omega / exact - 1),
                      reduced == 0 ? "" : fmt::format("{:.10g}", reduced / time));
  }
  csv.flush();
}

/// One shape for each frequency, on the ball at rest, its largest displacement one radius.
void write_shapes(const std::vector<BallFrequency>& frequencies, const continuum::BallSpace& space,
                  const RunContext& context) {
  const continuum::NodalGrid reference = continuum::nodal_grid(space);
  const double length = context.units.length;
  const auto scaled = [&](std::vector<double> values) {
    for (double& value : values) value *= length;
    return values;
  };
  io::PvdCollection list(context.directory.pvd("modes"));
  const std::size_t n_shapes =
      std::min<std::size_t>(frequencies.size(), static_cast<std::size_t>(context.scene.output.frames));
  for (std::size_t i = 0; i < n_shapes; ++i) {
    const BallFrequency& f = frequencies[i];
    const auto file = context.directory.frame("modes", static_cast<int>(i));
    io::write_vtu(file, {.points = scaled(reference.points),
                         .connectivity = reference.connectivity,
                         .fields = {{"displacement", 3, scaled(mode_displacement(space, f.parity, f.shape))}}});
    list.add(static_cast<double>(i + 1), file);
  }
}

}  // namespace

ModelOutcome run_modes(const RunContext& context) {
  const scene::Scene& scene = context.scene;
  const auto start = Clock::now();
  const continuum::StoredEnergy stored = stored_energy(scene);
  const continuum::BallSpace space(continuum::BallMesh({{true, true, true}}, *scene.continuum.refinements),
                                   *scene.continuum.degree);
  const auto kernels = continuum::make_cell_kernels(space, stored);
  std::optional<continuum::SurfaceGravityForces> gravity;
  if (const double G = loads::constant_forcing(internal_loads(scene)).gravity_constant; G > 0)
    gravity.emplace(G, space, scene.continuum.gravity_points.value_or(continuum::n_gravity_points(space, false)));
  const continuum::RestProblem problem(space, *kernels, stored, scene.body.incompressible, std::move(gravity));
  std::vector<BallFrequency> frequencies;
  continuum::ModesReport report;
  ModelOutcome outcome;
  const mechanics::Status status =
      ball_modes(problem, scene.modes.number, frequencies, report, [&] { return context.interrupted(); });
  auto& [counters, timers] = outcome.statistics;
  timers["run"] = std::chrono::duration<double>(Clock::now() - start).count();
  counters["cells"] = space.n_cells();
  counters["unknowns"] = 3.0 * space.n_nodes();
  counters["eigenpairs"] = report.n_eigenpairs;
  counters["applications_of_the_inverse"] = static_cast<double>(report.n_applications);
  if (!status) {
    outcome.end = context.interrupted() ? mechanics::Outcome::interrupted : mechanics::Outcome::failed;
    outcome.message = status.reason();
    return outcome;
  }
  write_table(frequencies, problem, context);
  if (context.needs.graphics) write_shapes(frequencies, space, context);
  context.log->info("modes: {} frequencies, {:.3g} s", frequencies.size(), timers["run"]);
  return outcome;
}

}  // namespace pseudorigid::app
