#pragma once
/// Output of critical points of a potential (mechanics/equilibria/critical_points.h), for the pseudo-rigid body and for
/// other systems.

#include <vector>

#include "app/run/run_context.h"
#include "mechanics/equilibria/critical_points.h"
#include "scene/catalogue.h"

namespace pseudorigid::app {

/// Columns of a critical point for `n_modes` degrees of freedom. The first four have the Morse index, the nullity, and
/// the dimensions of the unstable and the stable manifold. The others have the eigenvalues of the Hessian of the
/// potential and the rates of small motions.
std::vector<scene::Column> critical_point_columns(int n_modes);
/// Appends the values of these columns to `row`.
void append_critical_point(const mechanics::CriticalPoint& point, std::vector<double>& row);

/// Adds the number of points and a line for each point to the results of `outcome`. Adds the counters of the search to
/// the statistics of `outcome`. `energy` is the unit of the potential V.
void report_search(const mechanics::CriticalPoints& found, double energy, const RunContext& context,
                   ModelOutcome& outcome);

}  // namespace pseudorigid::app
