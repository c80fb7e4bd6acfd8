#pragma once
/// The effort of a run of the continuum, estimated before anything is built, as text and as a guard: unknowns, memory,
/// and the largest stable step of small motions about rest,
///
///   h = 0.38/(k (k + 0.4)) · 0.493^r / √(μ + 0.296 λ)      (RATTLE, μ, λ Lamé's moduli at rest, ρ = 1, radius 1)
///
/// for degree k and r refinements of the builtin mesh. If volume is preserved, λ is that of the law without its
/// function of J, which is 0 for neo-Hookean balls. Fitted to the largest frequencies that Lanczos' method finds:
/// within 2 % for k = 2 … 8, r = 0 … 2, and within 3 % for λ/μ = 0.1 … 100. A viscosity η makes steps dearer, by the
/// largest rate of damping
///
///   γ = 4 η (0.38/(k (k + 0.4)) · 0.493^r)⁻²      (at rest, viscous force and stiffness are proportional).

#include <cstddef>
#include <optional>
#include <string>

#include "scene/discretization.h"
#include "scene/needs.h"
#include "scene/read_scene.h"

namespace pseudorigid::app {

/// Estimates; bytes are within a third of the measured ones.
struct Effort {
  double n_unknowns, n_multipliers, bytes;
  double checkpoint_bytes;     ///< with the memory of the method; complete on the first rank
  double n_points_of_picture;  ///< points of the whole ball; elements do not share points
};

/// `n_coarse_cells`: of the mesh file; 0 for the builtin mesh.
Effort effort_of(const scene::Scene& scene, const scene::Discretization& discretization, std::size_t n_coarse_cells);

/// "12 kB", "9000 MB", "12 GB".
std::string in_bytes(double bytes);

/// The largest stable step of the scene's method on the builtin mesh, in the user's unit of time; methods that the
/// program chooses are counted as RATTLE.
double stable_step(const scene::Scene& scene, const scene::Discretization& discretization);

/// scene::needs, with lines about the effort of the continuum and a warning of a step that is not stable.
scene::Needs needs_with_effort(const scene::Scene& scene);

/// Why a discretisation cannot be built here: it takes more memory than there is for each of the ranks, or more
/// unknowns than have numbers. `n_coarse_cells`: of the mesh file; 0 for the builtin mesh.
std::optional<std::string> exceeds_memory(const scene::Scene& scene, const scene::Discretization& discretization,
                                          std::size_t n_coarse_cells, double share);

/// Throws UserError if the scene's discretisation, or the coarsest of a search, cannot be built.
void require_memory(const scene::Scene& scene, const scene::Origins& origins, std::size_t n_coarse_cells, double share);

}  // namespace pseudorigid::app
