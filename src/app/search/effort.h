#pragma once
/// Estimate of the effort of a finite-element run before anything is built: unknowns, memory, and the largest stable
/// step. It is shown to the user, and runs that exceed the memory are refused. The stable step of RATTLE for small
/// motions about rest is
///
///   h = 0.38/(k (k + 0.4)) · 0.493^r / √(μ + 0.296 λ)      (μ, λ Lamé's moduli at rest, ρ = 1, radius 1)
///
/// for degree k and r refinements of the builtin mesh. λ includes the volumetric stiffness. For an incompressible body,
/// the law contributes to λ without its function of J; this part is 0 for neo-Hookean balls. The formula is fitted to
/// the largest frequencies that Lanczos' method finds: within 2 % for k = 2 … 8, r = 0 … 2, and within 3 % for λ/μ =
/// 0.1 … 100. A viscosity η makes steps more expensive, depending on the largest damping rate
///
///   γ = 4 η (0.38/(k (k + 0.4)) · 0.493^r)⁻²      (at rest, viscous force and stiffness are proportional).

#include <cstddef>
#include <optional>
#include <string>

#include "scene/discretization.h"
#include "scene/needs.h"
#include "scene/read_scene.h"

namespace pseudorigid::app {

/// Estimated size of a run. The bytes are within a third of the measured memory.
struct Effort {
  double n_unknowns, n_multipliers, bytes;
  double checkpoint_bytes;     ///< with the memory of the method, on the first rank
  double n_points_of_picture;  ///< points of the whole ball; each element has its own points
};

/// `n_coarse_cells`: number of cells in the mesh file, 0 for the builtin mesh.
Effort effort_of(const scene::Scene& scene, const scene::Discretization& discretization, std::size_t n_coarse_cells);

/// A size as text, for example "12 kB", "9000 MB", "12 GB".
std::string in_bytes(double bytes);

/// The largest stable step of the scene's method on the builtin mesh, in the user's unit of time. If the program
/// chooses the method, it is the step of RATTLE.
double stable_step(const scene::Scene& scene, const scene::Discretization& discretization);

/// The result of scene::needs with lines about the effort of the finite-element run, and with a warning if the step is
/// not stable.
scene::Needs needs_with_effort(const scene::Scene& scene);

/// The reason why a discretisation cannot be built here; empty if it can. Either it needs more memory than this machine
/// has, or there are more unknowns than a 32-bit index can number. `n_coarse_cells` is the number of cells in the mesh
/// file, 0 for the builtin mesh. `share` is the part of the run's memory that the ranks on this machine need.
std::optional<std::string> exceeds_memory(const scene::Scene& scene, const scene::Discretization& discretization,
                                          std::size_t n_coarse_cells, double share);

/// Throws UserError if the scene's discretisation, or the coarsest of a search, cannot be built.
void require_memory(const scene::Scene& scene, const scene::Origins& origins, std::size_t n_coarse_cells, double share);

}  // namespace pseudorigid::app
