#pragma once
/// Analysis = equilibrium: the critical points of a system's potential (mechanics/equilibria/critical_points.h) as
/// equilibria.csv.
///
/// One row per point, in the order of rising potential, with the rates of the system as it is. For the counts
/// n_unstable and n_stable a system without dissipation gets the force −M v / (unit of time), so that 5.8.3 applies.

#include <vector>

#include "app/run/run_context.h"
#include "mechanics/equilibria/any_landscape.h"
#include "mechanics/equilibria/critical_points.h"
#include "systems/system_scene.h"

namespace pseudorigid::app {

/// The columns for a system with these coordinates and n_modes degrees of freedom.
std::vector<scene::Column> equilibria_columns(const std::vector<scene::Column>& coordinates, int n_modes);

/// Finds and writes them. `coordinates` are the names of the coordinates, and `scales` belong to the landscape.
/// `points`, with the system's own rates, are for callers that continue from them.
ModelOutcome run_equilibria(const mechanics::AnyLandscape& landscape, bool dissipative,
                            const std::vector<scene::Column>& coordinates, const systems::Scales& scales,
                            const RunContext& context, mechanics::CriticalPoints* points = nullptr);

}  // namespace pseudorigid::app
