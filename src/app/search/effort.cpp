#include "app/search/effort.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "app/run/scene_to_model.h"
#include "io/available_memory.h"
#include "materials/rest_moduli.h"
#include "mechanics/equilibria/figure_solver_limits.h"
#include "mechanics/methods/methods.h"
#include "mechanics/methods/time_loop.h"
#include "scene/bulk.h"
#include "scene/models.h"
#include "scene/stabilization.h"
#include "scene/user_error.h"

namespace pseudorigid::app {
namespace {

/// Numbers of vertices, edges, faces and cells of a part of the unrefined builtin mesh. The function n_nodes(n) returns
/// the number of nodes of the part if the nodes divide each edge into n intervals.
struct Part {
  double n_vertices, n_edges, n_faces, n_cells;
  double n_nodes(double n) const { return n_vertices + (n - 1) * (n_edges + (n - 1) * (n_faces + (n - 1) * n_cells)); }
};
constexpr Part octant{15, 28, 18, 4}, quarter_disc{7, 9, 3, 0}, half_axis{3, 2, 0, 0};

/// Number of nodes of 1, 2, 4 or 8 octants, with n intervals between the nodes of each edge. Neighbouring octants share
/// quarter discs, and quarter discs share half axes and the centre.
double n_nodes_of_images(int n_octants, double n) {
  const double O = octant.n_nodes(n), D = quarter_disc.n_nodes(n), A = half_axis.n_nodes(n);
  if (n_octants == 8) return 8 * O - 12 * D + 6 * A - 1;
  if (n_octants == 4) return 4 * O - 4 * D + A;
  return n_octants == 2 ? 2 * O - D : O;
}

/// Bytes per unknown, and bytes per pair of multipliers in a cell. These sizes were fitted to measurements of the
/// resident memory for degrees k = 2 … 8 and r = 0 … 3 refinements. The memory of a process that has only loaded the
/// libraries was subtracted.
constexpr double bytes_of_unknown = 600, bytes_of_pair_of_multipliers = 60;
/// Number of doubles in a checkpoint per unknown and per multiplier: positions, velocities, and the past steps that the
/// method symmetric-4 stores. Among the methods for the ball, symmetric-4 stores the largest number of past steps. If
/// the program chooses the step, a checkpoint also has the last sample, and its size doubles.
constexpr double remembered_of_unknown = 11, remembered_of_multiplier = 5;
constexpr double most_unknowns = std::numeric_limits<int>::max();  // the indices of PETSc and deal.II have 32 bits

std::string count(double n) { return n < 1e7 ? fmt::format("{:.0f}", n) : fmt::format("{:.3g}", n); }

/// The numbers of unknowns and multipliers and the memory as text. The text has at least 1 MB of memory.
std::string in_words(const Effort& e) {
  const std::string multipliers = e.n_multipliers > 0 ? " and " + count(e.n_multipliers) + " multipliers" : "";
  return fmt::format("{} unknowns{}, about {}", count(e.n_unknowns), multipliers, in_bytes(std::max(1e6, e.bytes)));
}

/// Stable step of RATTLE on the builtin mesh for λ = 0, μ = 1, density 1 and radius 1.
double step_of_mesh(const scene::Discretization& d) {
  return 0.38 / (d.degree * (d.degree + 0.4)) * std::pow(0.493, d.refinements);
}

/// Seconds per step and unknown of the finite-element model, for an incompressible and for a compressible body.
/// Measured times differ from these values by a factor of at most 3. They were measured on cores of 2 to 4 GHz for
/// degrees k = 3 … 6 and r = 0 … 1 refinements.
constexpr double seconds_of_unknown = 1e-7, seconds_of_compressible_unknown = 1e-8;
/// Typical ratio of the step to the stability limit at rest, if the program chooses the step for a tolerance.
constexpr double usual_part_of_limit = 0.6;
/// Typical costs of the pilot runs and of the companion run, relative to the cost of the run.
constexpr double pilots = 0.5, companion = 0.35;

/// The viscosity η in internal units.
double viscosity(const scene::Scene& scene) { return loads::constant_forcing(internal_loads(scene)).viscosity; }

/// The product γh on the builtin mesh, with the largest damping rate γ at rest and the step h. `step` is h in the
/// user's unit of time.
double damping_of_step(const scene::Scene& scene, const scene::Discretization& d, double step) {
  return 4 * viscosity(scene) / std::pow(step_of_mesh(d), 2) * step / units_of(scene).time;
}

/// Cost of a step of RATTLE in force evaluations; 1 without viscosity. Products with the viscosity matrix count as
/// force evaluations. `gamma_h` is γh, with the largest damping rate γ and the step h (mechanics/core/damping.h).
double work_of_viscous_step(double gamma_h) { return gamma_h > 0 ? 3 + 5 * std::pow(1 + gamma_h / 2, 0.4) : 1; }

/// Estimated time in seconds of the run on one core, with pilot runs and the companion run. `step` is in the user's
/// unit of time.
double seconds_of_continuum(const scene::Scene& scene, const scene::Needs& needs, double n_steps, double step) {
  const double n_unknowns = effort_of(scene, *scene::fixed_discretization(scene), 0).n_unknowns;
  const double a_step = n_unknowns * (needs.pressure_space ? seconds_of_unknown : seconds_of_compressible_unknown) *
                        work_of_viscous_step(damping_of_step(scene, *scene::fixed_discretization(scene), step));
  return n_steps * a_step * (1 + (scene.time.step ? 0 : pilots) + (needs.companion ? companion : 0));
}

/// Adds a line with the number of force evaluations of the pseudo-rigid body and their total time. A method of order 8
/// with the tolerance 1e-6 needs 73 evaluations per internal unit of time (measured). The number is proportional to the
/// tolerance to the power −1/8. If the scene gives the step, the number is at least that of these steps. Adds nothing
/// without a motion of this model.
void describe_small_model(const scene::Scene& scene, scene::Needs& needs) {
  const auto model = std::ranges::find_if(needs.models, [](const auto* m) { return !m->has_nonaffine; });
  if (model == needs.models.end() || scene.analysis != scene::Analysis::motion) return;
  constexpr double seconds_of_force = 1e-7;
  const double end = scene.time.end / units_of(scene).time;
  double n = 73 * std::pow(scene.time.tolerance / 1e-6, -1.0 / 8) * end;
  if (scene.time.step) n = std::max(n, scene.time.end / *scene.time.step);
  needs.needed.push_back(fmt::format("effort of the {} model: roughly {:.1g} evaluations of the force, {:.1g} s",
                                     (*model)->name, n, n * seconds_of_force));
}

/// Adds a line with the time of all runs of the sweep, if each run takes `seconds_of_run`. Adds nothing without a
/// sweep.
void describe_effort_of_sweep(const scene::Scene& scene, double seconds_of_run, scene::Needs& needs) {
  if (scene.sweep.empty()) return;
  const auto [first, end] = scene::runs_of_part(scene.sweep_part, scene::n_runs(scene.sweep));
  needs.needed.push_back(
      fmt::format("effort of the sweep: roughly {:.1g} s on one core, if all {} runs are like the first",
                  seconds_of_run * (end - first), end - first));
}

/// The way in which the finite elements solve linear equations with the stiffness.
enum class Solver { none, cycles, factors };

Solver solver_of(const scene::Scene& scene, double n_unknowns) {
  if (scene.analysis == scene::Analysis::motion) return Solver::none;
  const bool finds_figures_alone = scene.analysis == scene::Analysis::equilibrium && !scene.equilibria.small_motions;
  return finds_figures_alone && n_unknowns > mechanics::most_factorized_unknowns &&
                 gravity_to_elasticity(scene) <= mechanics::largest_ratio_of_cycles
             ? Solver::cycles
             : Solver::factors;
}

/// Bytes of the factors of one parity (continuum/modes/parity_sector.h), and of the entries before the factorisation.
struct Factors {
  double kept = 0, temporary = 0;
};

/// The factors for elements of degree k. Each cell has the blocks of its own unknowns and of those that it shares. The
/// unknowns between cells have a sparse Cholesky factor. Its size and that of the temporary entries are fitted to the
/// runs of effort.h.
Factors factors_of(double k, double n_unknowns, double n_cells, double n_pressure) {
  const double own = 3 * std::pow(k - 1, 3), all = 3 * std::pow(k + 1, 3), shared = all - own;
  const double n_between = std::max(0.0, n_unknowns - own * n_cells);
  return {sizeof(double) * n_cells * (own * all + n_pressure * all) + 500 * std::pow(n_between, 4.0 / 3),
          20 * n_cells * shared * shared};
}

}  // namespace

std::string in_bytes(double bytes) {
  if (bytes < 1e6) return fmt::format("{:.0f} kB", std::ceil(bytes / 1e3));
  return bytes < 1e10 ? fmt::format("{:.0f} MB", bytes / 1e6) : fmt::format("{:.0f} GB", bytes / 1e9);
}

Effort effort_of(const scene::Scene& scene, const scene::Discretization& d, std::size_t n_coarse_cells) {
  const double n = std::ldexp(d.degree, d.refinements), k = d.degree;
  const int n_octants = 8 / scene::sector(scene).n_images();
  const bool builtin = n_coarse_cells == 0;
  const double n_coarse = builtin ? octant.n_cells * n_octants : static_cast<double>(n_coarse_cells);
  // For a mesh file, the number of nodes is estimated as that of a cube with the same number of cells.
  const double n_nodes = builtin ? n_nodes_of_images(n_octants, n) : std::pow(std::cbrt(n_coarse) * n + 1, 3);
  const double n_cells = n_coarse * std::ldexp(1, 3 * d.refinements);
  const bool has_pressure = scene.body.incompressible || scene::projects_bulk(scene);
  const double n_pressure = has_pressure ? k * (k + 1) * (k + 2) / 6 : 0;
  const double n_unknowns = 3 * n_nodes, n_multipliers = n_cells * n_pressure;
  const bool gravitates = loads::present(scene.loads.get<loads::SelfGravity>());
  const Solver solver = solver_of(scene, n_unknowns);
  // The stiffness of each cell as a dense matrix, and with self-gravity a part of it.
  const int n_matrices = solver != Solver::factors ? 0 : gravitates ? 2 : 1;
  const double entries_of_cell = std::pow(3 * std::pow(k + 1, 3), 2);
  // The numbers of V-cycles at each Gauss point, in double and in single precision (continuum/statics/multigrid.h).
  constexpr double bytes_of_point = 45 * (sizeof(double) + 2 * sizeof(float));
  const double of_cycles = solver == Solver::cycles ? bytes_of_point * std::pow(k + 1, 3) * n_cells : 0;
  const Factors factors = solver == Solver::none     ? Factors{}
                          : solver == Solver::cycles ? factors_of(1, n_unknowns / (k * k * k), n_cells, 0)
                                                     : factors_of(k, n_unknowns, n_cells, n_pressure);
  // Modes and Love numbers keep the factors of four parities, the small motions about a figure those of two.
  const bool finds_figures = scene.analysis == scene::Analysis::equilibrium;
  const int n_parities = !finds_figures ? 4 : scene.equilibria.small_motions ? 2 : 1;
  // Self-gravity couples all unknowns of the surface. Their matrix and its factors exist for up to eight parities, but
  // in modes only for a small surface (continuum/modes/rest_problem.h).
  constexpr double bytes_of_pair_at_surface = 8 * 2 * sizeof(double);
  const double n_at_surface = n_matrices == 2 ? 9 * n * n : 0;
  const bool has_matrix = scene.analysis == scene::Analysis::equilibrium || n_at_surface <= 3000;
  const double of_parities =
      n_parities * factors.kept + (has_matrix ? bytes_of_pair_at_surface * n_at_surface * n_at_surface : 0);
  return {.n_unknowns = n_unknowns,
          .n_multipliers = n_multipliers,
          .bytes = bytes_of_unknown * n_unknowns + bytes_of_pair_of_multipliers * n_multipliers * n_pressure +
                   n_matrices * sizeof(double) * entries_of_cell * n_cells + of_cycles + factors.temporary +
                   of_parities,
          .bytes_of_parities = of_parities,
          .checkpoint_bytes = (scene.time.step ? 1 : 2) * sizeof(double) *
                              (remembered_of_unknown * n_unknowns + remembered_of_multiplier * n_multipliers),
          .n_points_of_picture = n_cells * (builtin ? 8.0 / n_octants : 1) * std::pow(k + 1, 3)};
}

double stable_step(const scene::Scene& scene, const scene::Discretization& d) {
  const double of_mesh = step_of_mesh(d);
  const double kappa = scene::volumetric_stiffness_of_elements(scene) / units_of(scene).stress();
  const auto [mu, lambda] = materials::moduli_at_rest(discrete_law(scene).law, scene.body.incompressible);
  const double rattle = of_mesh / std::sqrt(mu + 0.296 * (lambda + kappa)) * units_of(scene).time;
  const auto method = mechanics::find_method(scene.time.method);
  if (!method) return rattle;
  return mechanics::with_method(*method, [&]<class Method>(Method) {
    if constexpr (Method::adaptive)
      return std::numeric_limits<double>::infinity();
    else
      return rattle * (Method::stability_limit / mechanics::Rattle::stability_limit);
  });
}

scene::Needs needs_with_effort(const scene::Scene& scene) {
  scene::Needs needs = scene::needs(scene);
  describe_small_model(scene, needs);
  const auto fixed = scene::fixed_discretization(scene);
  if (!needs.discretized || !fixed || scene::has_mesh_file(scene)) return needs;
  needs.needed.push_back("effort of the continuum: " + in_words(effort_of(scene, *fixed, 0)));
  if (scene.analysis != scene::Analysis::motion) return needs;
  const auto method = mechanics::find_method(scene.time.method);
  const double limit = stable_step(scene, *fixed);
  const auto name = mechanics::method_name(method.value_or(mechanics::id_of<mechanics::Rattle>));
  needs.needed.back() += fmt::format("; {} is stable at rest up to a step of about {:.3g}", name, limit);
  if (!method || !scene.time.step) {
    // A method that the program chooses takes Time/Step as an upper bound.
    const double usual = std::min(usual_part_of_limit * limit, scene.time.step.value_or(limit)),
                 n_steps = std::ceil(scene.time.end / usual);
    const double seconds = seconds_of_continuum(scene, needs, n_steps, usual);
    needs.needed.back() += fmt::format("; roughly {:.1g} steps and {:.1g} s on one core", n_steps, seconds);
    describe_effort_of_sweep(scene, seconds, needs);
    return needs;
  }
  const mechanics::SampleTimes times{scene.time.end, scene.output.samples};
  const double n_steps = static_cast<double>(times.steps_per_interval(*scene.time.step));
  const double step = times.interval() / n_steps;
  needs.needed.back() += fmt::format(" and takes {} steps of {:.3g}", count(n_steps * scene.output.samples), step);
  const double seconds = seconds_of_continuum(scene, needs, n_steps * scene.output.samples, step);
  needs.needed.back() += fmt::format(", roughly {:.1g} s on one core", seconds);
  describe_effort_of_sweep(scene, seconds, needs);
  if (step > limit)
    needs.warnings.push_back(
        fmt::format("Time/Step: steps of {:.3g} are above the stability limit of the continuum, about {:.3g} for small "
                    "motions at rest; expect a stop after a few steps, with an element turned inside out",
                    step, limit));
  return needs;
}

std::optional<std::string> exceeds_memory(const scene::Scene& scene, const scene::Discretization& discretization,
                                          std::size_t n_coarse_cells, double share, double share_of_parities) {
  const Effort needed = effort_of(scene, discretization, n_coarse_cells);
  const std::string takes = fmt::format("{} takes {}", scene::describe(discretization), in_words(needed));
  if (needed.n_unknowns > most_unknowns || needed.n_multipliers > most_unknowns)
    return fmt::format("{}, and no more than {:.3g} have numbers", takes, most_unknowns);
  const double available = io::available_memory();
  // The checkpoint is collected on the first rank. This rank may be on this machine, so the estimate includes the part
  // of the checkpoint from the other machines.
  const double here = share * (needed.bytes - needed.bytes_of_parities) + share_of_parities * needed.bytes_of_parities +
                      std::max(0.0, 1 - share) * needed.checkpoint_bytes;
  if (here <= available) return std::nullopt;
  return fmt::format("{}{}, and {} are available here", takes,
                     share < 1   ? fmt::format(", of which this machine needs {}", in_bytes(here))
                     : share > 1 ? fmt::format(" on each rank, together {}", in_bytes(here))
                                 : "",
                     in_bytes(available));
}

void require_memory(const scene::Scene& scene, const scene::Origins& origins, std::size_t n_coarse_cells,
                    int n_ranks_here, int n_ranks) {
  if (!scene::is_discretized(scene)) return;
  constexpr const char* entry = "Continuum/Refinements";
  const auto fixed = scene::fixed_discretization(scene);
  // In analyses other than motions, each rank has the whole octant, but only the factors of some of the eight parities.
  const double of_all = n_ranks_here, share = of_all / (scene.analysis == scene::Analysis::motion ? n_ranks : 1),
               of_rank = std::ceil(8.0 / n_ranks) / 8;
  if (const auto problem =
          exceeds_memory(scene, fixed ? *fixed : scene::ladder(scene).front(), n_coarse_cells, share, of_all * of_rank))
    throw UserError(fmt::format("{}: {}: {}", origins.of(entry), entry, *problem));
}

}  // namespace pseudorigid::app
