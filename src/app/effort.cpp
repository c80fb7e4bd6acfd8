#include "app/effort.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>

#include "app/scene_to_model.h"
#include "materials/eigen_tensor.h"
#include "scene/user_error.h"

namespace pseudorigid::app {
namespace {

/// Of the octant's four cells; other sectors and refinements are counted as images of it.
struct Octant {
  static constexpr double n_vertices = 15, n_edges = 28, n_faces = 18, n_cells = 4;
};

/// Measured as resident memory over that of a process that has only linked its libraries: with k = 2 … 8, r = 0 … 3.
constexpr double bytes_of_unknown = 600, bytes_of_pair_of_multipliers = 60;
constexpr double most_unknowns = std::numeric_limits<int>::max();  // PETSc's and deal.II's own numbers

/// λ and μ of small motions, whatever c ln J is added to W: b(H) = H:DP(Id)[H] + p tr H², P(Id) = p Id, is
/// λ (tr H)² + 2μ tr H² for symmetric H.
std::pair<double, double> lame_moduli(const materials::AnyLaw& law) {
  const materials::Tensor<double> Id = materials::to_tensor(Eigen::Matrix3d::Identity());
  const auto b = [&](const Eigen::Matrix3d& H) {
    const materials::Tensor<double> h = materials::to_tensor(H);
    return std::visit(
        [&](const auto& l) { return materials::dot(h, l.tangent(Id, h)) + l.stress(Id)(0, 0) * (H * H).trace(); }, law);
  };
  const double mu = b(Eigen::Vector3d(1, -1, 0).asDiagonal()) / 4;
  return {(b(Eigen::Matrix3d::Identity()) - 6 * mu) / 9, mu};
}

std::string count(double n) { return n < 1e7 ? fmt::format("{:.0f}", n) : fmt::format("{:.3g}", n); }

std::string in_words(const Effort& e) {
  const std::string multipliers = e.n_multipliers > 0 ? " and " + count(e.n_multipliers) + " multipliers" : "";
  const double megabytes = e.bytes / 1e6;
  return fmt::format("{} unknowns{}, about {}", count(e.n_unknowns), multipliers,
                     megabytes < 1000 ? fmt::format("{:.0f} MB", std::max(1.0, megabytes))
                                      : fmt::format("{:.0f} GB", megabytes / 1000));
}

Effort effort_of(const scene::Scene& scene, const scene::Discretization& d, std::size_t n_coarse_cells) {
  const double n_cells =
      n_coarse_cells > 0 ? static_cast<double>(n_coarse_cells) : Octant::n_cells * 8 / scene::sector(scene).n_images();
  return effort(d, n_cells, scene.body.incompressible);
}

/// Bytes that a process may still take on this machine; infinite where the system does not tell.
double available_memory() {
  std::ifstream file("/proc/meminfo");
  for (std::string name; file >> name;)
    if (double kilobytes; name == "MemAvailable:" && file >> kilobytes) return 1024 * kilobytes;
  return std::numeric_limits<double>::infinity();
}

}  // namespace

Effort effort(const scene::Discretization& d, double n_coarse_cells, bool incompressible) {
  const double n = std::ldexp(d.degree, d.refinements), inside = n - 1;
  const double n_nodes = (Octant::n_vertices + inside * (Octant::n_edges + inside * (Octant::n_faces + inside * 4))) *
                         (n_coarse_cells / Octant::n_cells);
  const double n_cells = n_coarse_cells * std::ldexp(1, 3 * d.refinements), k = d.degree;
  const double n_pressure = incompressible ? k * (k + 1) * (k + 2) / 6 : 0;
  return {.n_unknowns = 3 * n_nodes,
          .n_multipliers = n_cells * n_pressure,
          .bytes = bytes_of_unknown * 3 * n_nodes + bytes_of_pair_of_multipliers * n_cells * n_pressure * n_pressure};
}

double stable_step(const scene::Scene& scene, const scene::Discretization& d) {
  const auto [lambda, mu] = lame_moduli(internal_law(scene));
  const double of_mesh = 0.38 / (d.degree * (d.degree + 0.4)) * std::pow(0.493, d.refinements);
  const double rattle = of_mesh / std::sqrt(mu + 0.296 * lambda) * units_of(scene).time;
  const auto method = method_of(scene);
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
  const auto fixed = scene::fixed_discretization(scene);
  if (!needs.continuum || !fixed || scene::has_mesh_file(scene)) return needs;
  needs.needed.push_back("effort of the continuum: " + in_words(effort_of(scene, *fixed, 0)));
  if (scene.analysis != scene::Analysis::motion) return needs;
  const double limit = stable_step(scene, *fixed), step = scene.time.step.value_or(limit);
  const auto method = method_of(scene);
  needs.needed.back() += fmt::format("; the largest stable step of {} at rest is about {:.3g}, {} {} steps",
                                     mechanics::method_name(method.value_or(mechanics::id_of<mechanics::Rattle>)),
                                     limit, scene.time.step ? "the one given makes" : "which makes",
                                     count(std::ceil(scene.time.end / step * (1 - 1e-12))));
  if (step > limit)
    needs.warnings.push_back(
        fmt::format("Time/Step: {} is above the stability limit of the continuum, about {:.3g} for small motions at "
                    "rest; expect a stop after a few steps, with an element turned inside out",
                    scene::print_number(step), limit));
  return needs;
}

std::optional<std::string> exceeds_memory(const scene::Scene& scene, const scene::Discretization& discretization,
                                          std::size_t n_coarse_cells, int n_ranks) {
  const Effort needed = effort_of(scene, discretization, n_coarse_cells);
  const std::string takes = fmt::format("{} takes {}", scene::describe(discretization), in_words(needed));
  if (needed.n_unknowns > most_unknowns || needed.n_multipliers > most_unknowns)
    return fmt::format("{}, and no more than {:.3g} have numbers", takes, most_unknowns);
  const double available = available_memory();
  if (needed.bytes / n_ranks <= available) return std::nullopt;
  return fmt::format("{}, and {:.0f} GB are available here", takes, available / 1e9) +
         (n_ranks > 1 ? fmt::format(" to each of {} ranks", n_ranks) : "");
}

void require_memory(const scene::Scene& scene, const scene::Origins& origins, std::size_t n_coarse_cells, int n_ranks) {
  if (!scene.models.continuum || scene.analysis == scene::Analysis::equilibrium) return;
  constexpr const char* entry = "Continuum/Refinements";
  const auto fixed = scene::fixed_discretization(scene);
  if (const auto problem =
          exceeds_memory(scene, fixed ? *fixed : scene::ladder(scene).front(), n_coarse_cells, n_ranks))
    throw UserError(fmt::format("{}: {}: {}", origins.of(entry), entry, *problem));
}

}  // namespace pseudorigid::app
