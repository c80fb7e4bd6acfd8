#pragma once
/// Output of critical points (mechanics/equilibria/critical_points.h), for any coordinates.

#include <vector>

#include "app/run/run_context.h"
#include "mechanics/equilibria/critical_points.h"
#include "scene/catalogue.h"

namespace pseudorigid::app {

/// Columns for the Morse index, the nullity and the dimensions of the invariant manifolds of a critical point. They
/// also contain the eigenvalues of the Hessian of the potential and the rates of small motions, for n_modes degrees of
/// freedom.
std::vector<scene::Column> critical_point_columns(int n_modes);
void append_critical_point(const mechanics::CriticalPoint& point, std::vector<double>& row);

/// Writes the lines of the results and the counters of the manifest. `energy` is the unit of V.
void report_search(const mechanics::CriticalPoints& found, double energy, const RunContext& context,
                   ModelOutcome& outcome);

}  // namespace pseudorigid::app
