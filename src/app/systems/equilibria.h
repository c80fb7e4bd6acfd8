#pragma once
/// Runs `Analysis = equilibrium` for a system: finds the critical points of its potential
/// (mechanics/equilibria/critical_points.h) and writes them into equilibria.csv.
///
/// The file has a row for each point, by rising potential, with the rates of small motions of the system itself. For
/// the counts n_unstable and n_stable, a system without dissipation gets the force −M v / (unit of time). The result of
/// Oliva, Geometric Mechanics, 5.8.3 then applies.

#include <vector>

#include "app/run/run_context.h"
#include "mechanics/equilibria/any_landscape.h"
#include "mechanics/equilibria/critical_points.h"
#include "systems/system_scene.h"

namespace pseudorigid::app {

/// The columns for a system with these coordinates and n_modes degrees of freedom.
std::vector<scene::Column> equilibria_columns(const std::vector<scene::Column>& coordinates, int n_modes);

/// Finds and writes the critical points. `coordinates` are the columns of the coordinates, and `scales` are the units
/// of the landscape. If `points` is given, it receives the points with the rates of the system itself.
ModelOutcome run_equilibria(const mechanics::AnyLandscape& landscape, bool dissipative,
                            const std::vector<scene::Column>& coordinates, const systems::Scales& scales,
                            const RunContext& context, mechanics::CriticalPoints* points = nullptr);

}  // namespace pseudorigid::app
