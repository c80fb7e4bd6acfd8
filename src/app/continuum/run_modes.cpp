#include "app/continuum/run_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "app/continuum/rest_problem.h"
#include "app/continuum/sector_ranks.h"
#include "app/ranks/on_all_ranks.h"
#include "app/run/mode_table.h"
#include "app/run/scene_to_model.h"
#include "continuum/modes/modes.h"
#include "continuum/output/nodal_fields.h"
#include "io/block_cells.h"
#include "io/pvd.h"

namespace pseudorigid::app {
namespace {

using continuum::BallFrequency, continuum::ModeKind;
using Clock = std::chrono::steady_clock;

/// The rows of the table of modes for the computed frequencies.
std::vector<ModeFrequency> rows_of(const std::vector<BallFrequency>& frequencies) {
  std::vector<ModeFrequency> rows;
  for (const BallFrequency& f : frequencies)
    rows.push_back({f.omega, f.least, f.largest, f.kind == ModeKind::spheroidal, f.degree, f.overtone, f.multiplicity});
  return rows;
}

/// Writes a picture for each frequency: the displacement of the ball from rest in one mode of this frequency. The
/// largest displacement is one radius. The entry Output/Frames limits the number of pictures.
void write_shapes(const std::vector<BallFrequency>& frequencies, const continuum::BallSpace& space,
                  const RunContext& context) {
  const scene::Cells cells = context.scene.output.cells;
  const auto in_picture = [&](std::vector<double> values) {
    if (cells == scene::Cells::lagrange) continuum::make_equidistant(space, values);
    for (double& value : values) value *= context.units.length;
    return values;
  };
  io::UnstructuredGrid grid;
  grid.points = in_picture(continuum::nodal_positions(space));
  io::set_cells(grid, continuum::nodal_blocks(space), cells);
  io::PvdCollection list(context.directory.pvd("modes"));
  const std::size_t n_shapes =
      std::min<std::size_t>(frequencies.size(), static_cast<std::size_t>(context.scene.output.frames));
  for (std::size_t i = 0; i < n_shapes; ++i) {
    const BallFrequency& f = frequencies[i];
    const auto file = context.directory.frame("modes", static_cast<int>(i));
    grid.fields = {{"displacement", 3, in_picture(mode_displacement(space, f.parity, f.shape))}};
    io::write_vtu(file, grid);
    list.add(static_cast<double>(i + 1), file);
  }
}

}  // namespace

ModelOutcome run_modes(const RunContext& context) {
  const scene::Scene& scene = context.scene;
  const auto start = Clock::now();
  const BallAtRestOnMesh ball(scene, *scene::fixed_discretization(scene));
  const continuum::BallSpace& space = ball.space();
  const continuum::RestProblem& problem = ball.problem();
  std::vector<BallFrequency> frequencies;
  continuum::ModesReport report;
  ModelOutcome outcome;
  const mechanics::Status status = ball_modes(
      problem, scene.modes.number, frequencies, report, [&] { return context.interrupted(); }, sector_ranks(context));
  auto& counters = outcome.statistics.counters;
  auto& timers = outcome.statistics.timers;
  timers["run"] = std::chrono::duration<double>(Clock::now() - start).count();
  counters["cells"] = space.n_cells();
  counters["unknowns"] = 3.0 * space.n_nodes();
  counters["eigenpairs"] = report.n_eigenpairs;
  counters["applications_of_the_inverse"] = static_cast<double>(report.n_applications);
  const std::vector<ModeFrequency> rows = rows_of(frequencies);
  outcome.message = !status ? status.reason() : instability(rows, context.units);
  // The copies of a mode are the 2n + 1 modes of degree n that the sphere has at one frequency. A mesh breaks the
  // symmetry of the sphere, so the frequencies of the copies differ. A mesh whose copies differ relatively by more than
  // a tenth does not resolve the mode. A difference of more than a hundredth gives a warning.
  constexpr double most = 0.1;
  constexpr const char* remedy = "raise Continuum/Degree or Continuum/Refinements";
  if (const std::string copies = differing_copies(rows, most); outcome.message.empty() && !copies.empty())
    outcome.message = fmt::format("{}: the mesh is too coarse for it; {}", copies, remedy);
  if (!outcome.message.empty()) {
    outcome.end = context.interrupted() ? mechanics::Outcome::interrupted : mechanics::Outcome::failed;
    return outcome;
  }
  on_all_ranks(*context.ranks, [&] {
    write_mode_table(rows, {problem.elasticity.moduli, problem.incompressible, gravity_to_elasticity(scene)}, context,
                     mode_file(context.needs, "continuum"), outcome);
    if (context.needs.graphics && context.ranks->is_first()) write_shapes(frequencies, space, context);
  });
  if (const std::string copies = differing_copies(rows); !copies.empty())
    context.log->warn("{}, which is an error of the mesh; {}", copies, remedy);
  context.log->info("modes: {} frequencies, {:.3g} s", frequencies.size(), timers["run"]);
  return outcome;
}

}  // namespace pseudorigid::app
