#pragma once
/// Analysis = equilibrium: the critical points of a system's potential (mechanics/critical_points.h) as equilibria.csv.
///
/// One row a point, by rising potential: index, the configuration, potential, morse_index, nullity, n_unstable,
/// n_stable, the eigenvalues hessian_k of the potential's second derivative in the metric (squares of frequencies), and
/// the rates of the linearised dissipative field, rate_k = rate_k_re + i rate_k_im. A system without dissipation of its
/// own gets the force −M v / (unit of time), so that 5.8.3 speaks of it.

#include <vector>

#include "app/run_context.h"
#include "mechanics/any_landscape.h"
#include "systems/system_scene.h"

namespace pseudorigid::app {

/// Finds and writes them; `coordinates` name the configuration, `scales` are those of the landscape.
ModelOutcome run_equilibria(const mechanics::AnyLandscape& landscape, bool dissipative,
                            const std::vector<scene::Column>& coordinates, const systems::Scales& scales,
                            const RunContext& context);

}  // namespace pseudorigid::app
