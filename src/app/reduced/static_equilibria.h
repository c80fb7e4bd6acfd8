#pragma once
/// Static equilibria of the pseudo-rigid body of a scene (reduced/static_equilibria.h). With `Equilibrium/Family =
/// static` the program writes the critical points of the potential energy into equilibria.csv.

#include <vector>

#include "app/run/run_context.h"
#include "scene/catalogue.h"

namespace pseudorigid::app {

/// The columns of equilibria.csv for a body with n_modes degrees of freedom.
std::vector<scene::Column> static_equilibria_columns(int n_modes);

ModelOutcome run_static_equilibria(const RunContext& context);

}  // namespace pseudorigid::app
