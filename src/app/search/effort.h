#pragma once
/// Estimate of the unknowns, the memory and the largest stable step of a finite-element run before its mesh is built.
/// The program shows the estimate to the user, and refuses a run that needs more memory than the machine has. For small
/// motions about rest, the stable step of RATTLE is
///
///   h = 0.38/(k (k + 0.4)) · 0.493^r / √(μ + 0.296 λ)      (μ, λ Lamé's moduli at rest, ρ = 1, radius 1)
///
/// for degree k and r refinements of the builtin mesh. λ is the sum of the law's λ and the volumetric stiffness. For an
/// incompressible body, the laws neo-hookean, mooney-rivlin and gent have no bulk term, and the λ of neo-hookean is 0.
/// The formula is fitted to the largest frequencies from Lanczos' method. For k = 2 … 8 and r = 0 … 2, its error is
/// below 2 %. For λ/μ = 0.1 … 100, its error is below 3 %. At rest, the viscous force is proportional to the stiffness.
/// The largest damping rate for a viscosity η is
///
///   γ = 4 η (0.38/(k (k + 0.4)) · 0.493^r)⁻².
///
/// A larger product γh, with the step h, makes a step of RATTLE more expensive.

#include <cstddef>
#include <optional>
#include <string>

#include "scene/discretization.h"
#include "scene/needs.h"
#include "scene/read_scene.h"

namespace pseudorigid::app {

/// Estimated size of a run. The number n_unknowns is three times the number of nodes. The number of multipliers of the
/// constraint is n_multipliers, which is 0 for a compressible body. `bytes` is the memory of all ranks of a
/// motion together, or that of another analysis in one process.
/// In motions, estimated and measured memory differ by less than a third. In ten runs of other analyses with 54,000 to
/// 412,000 unknowns and more than 300 MB, the process took 0.8 to 1.6 times the estimate.
struct Effort {
  double n_unknowns, n_multipliers, bytes;
  double bytes_of_parities = 0;  ///< part of `bytes` that the ranks of an analysis share
  double checkpoint_bytes;       ///< bytes of a checkpoint on the first rank, with the memory of the method
  double n_points_of_picture;    ///< number of points in a picture of the whole ball; each element has its own points
};

/// The estimated size of a run. `n_coarse_cells` is the number of cells in the mesh file, or 0 for the builtin mesh.
Effort effort_of(const scene::Scene& scene, const scene::Discretization& discretization, std::size_t n_coarse_cells);

/// A size in bytes as text, for example "12 kB", "9000 MB", "12 GB".
std::string in_bytes(double bytes);

/// The largest stable step of the scene's method on the builtin mesh, in the user's unit of time. The step is infinite
/// for an adaptive method. If the program chooses the method, the function returns the step of RATTLE.
double stable_step(const scene::Scene& scene, const scene::Discretization& discretization);

/// The result of scene::needs with lines about the cost of the run. They have the force evaluations of the pseudo-rigid
/// model, and the size, the steps and the time of a finite-element run. For a sweep with finite elements, a further
/// line has the time of all runs. If the scene gives a method and an unstable step, there is also a warning. For
/// analyses other than a motion, there is only the size. There is no line for finite elements on a mesh file or without
/// a fixed discretisation.
scene::Needs needs_with_effort(const scene::Scene& scene);

/// The reason why this machine cannot compute with a discretisation; empty if it can. One reason is lack of memory. The
/// other reason is that a 32-bit index cannot number the unknowns or the multipliers. `n_coarse_cells` is the number of
/// cells in the mesh file, or 0 for the builtin mesh. `share` is the memory that the ranks on this machine need,
/// divided by that of a run in one process.
std::optional<std::string> exceeds_memory(const scene::Scene& scene, const scene::Discretization& discretization,
                                          std::size_t n_coarse_cells, double share, double share_of_parities = 1);

/// Throws UserError if this machine cannot compute with the scene's discretisation, or with the coarsest one of a
/// search (exceeds_memory). `n_ranks_here` of the `n_ranks` ranks are on this machine. In analyses other than a motion,
/// each rank has the whole octant. Does nothing if no finite elements are computed.
void require_memory(const scene::Scene& scene, const scene::Origins& origins, std::size_t n_coarse_cells,
                    int n_ranks_here, int n_ranks);

}  // namespace pseudorigid::app
