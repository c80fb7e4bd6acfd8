#pragma once
/// Runs `Analysis = equilibrium` for a system. The run finds the critical points of the potential of the system
/// (mechanics/equilibria/critical_points.h) and writes them into equilibria.csv.
///
/// The file has a row for each point, by increasing potential, with the rates of small motions of the system. The
/// counts n_unstable and n_stable, the dimensions of the unstable and the stable manifold, require dissipation. For
/// these counts only, a system without dissipation has the additional force −M v/(unit of time). Here M is the mass
/// matrix, and v is the velocity. If a point has no zero eigenvalue, the dimension of its unstable manifold is then its
/// Morse index (Oliva, Geometric Mechanics, 5.8.3).

#include <vector>

#include "app/run/run_context.h"
#include "mechanics/equilibria/any_landscape.h"
#include "mechanics/equilibria/critical_points.h"
#include "systems/system_scene.h"

namespace pseudorigid::app {

/// The columns of equilibria.csv for a system with the given columns of coordinates and n_modes degrees of freedom.
std::vector<scene::Column> equilibria_columns(const std::vector<scene::Column>& coordinates, int n_modes);

/// Finds the critical points and writes the file. `dissipative` is true if the system has dissipation of its own.
/// `coordinates` are the columns of the coordinates, and `scales` are the units of the landscape in the user's units.
/// If `points` is not null, it receives the critical points by increasing potential. The outcome is `failed` if the
/// search fails.
ModelOutcome run_equilibria(const mechanics::AnyLandscape& landscape, bool dissipative,
                            const std::vector<scene::Column>& coordinates, const systems::Scales& scales,
                            const RunContext& context, mechanics::CriticalPoints* points = nullptr);

}  // namespace pseudorigid::app
