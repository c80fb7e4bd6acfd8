#pragma once
/// Output of critical points of a potential (mechanics/equilibria/critical_points.h), for the pseudo-rigid body and for
/// other systems.

#include <vector>

#include "app/run/run_context.h"
#include "mechanics/equilibria/critical_points.h"
#include "scene/catalogue.h"

namespace pseudorigid::app {

/// Columns of a critical point for `n_modes` degrees of freedom. The first four have the Morse index, the nullity, and
/// the dimensions of the unstable and the stable manifold. The next n_modes columns have the eigenvalues of the Hessian
/// of the potential in the metric of the kinetic energy, in increasing order. The last 4 n_modes columns have the 2
/// n_modes rates z of small motions exp(zt). A rate has two columns, its real part and its imaginary part.
std::vector<scene::Column> critical_point_columns(int n_modes);
/// Appends the values of these columns, in internal units, to `row`.
void append_critical_point(const mechanics::CriticalPoint& point, std::vector<double>& row);

/// Adds a line with the numbers of points and starts to the results of `outcome`. Then adds a line for each point, with
/// its potential V, Morse index, nullity and dimensions of manifolds. Adds the counters of the search to the statistics
/// of `outcome`. The factor `energy` converts V from internal units to the user's units.
void report_search(const mechanics::CriticalPoints& found, double energy, const RunContext& context,
                   ModelOutcome& outcome);

}  // namespace pseudorigid::app
