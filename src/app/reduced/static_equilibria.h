#pragma once
/// Static equilibria of the pseudo-rigid body of a scene (reduced/static_equilibria.h). If Equilibrium/Family is
/// `static`, the program writes the critical points of the potential energy into equilibria.csv.

#include <vector>

#include "app/run/run_context.h"
#include "scene/catalogue.h"

namespace pseudorigid::app {

/// The columns of equilibria.csv for a body with n_modes degrees of freedom: 8 if it is incompressible, otherwise 9.
std::vector<scene::Column> static_equilibria_columns(int n_modes);

/// Searches for the critical points and writes the file. The outcome is `failed` if the search fails or finds no point;
/// no file is then written. Logs a warning if the numbers of points of each Morse index show that points are missing
/// (reduced/static_equilibria.h).
ModelOutcome run_static_equilibria(const RunContext& context);

}  // namespace pseudorigid::app
