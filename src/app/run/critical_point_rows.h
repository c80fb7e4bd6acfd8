#pragma once
/// Output of critical points (mechanics/equilibria/critical_points.h), for any coordinates.

#include <vector>

#include "app/run/run_context.h"
#include "mechanics/equilibria/critical_points.h"
#include "scene/catalogue.h"

namespace pseudorigid::app {

/// Morse index, nullity, dimensions of the invariant manifolds, second derivative and rates, of n_modes degrees of
/// freedom; in internal units.
std::vector<scene::Column> critical_point_columns(int n_modes);
void append_critical_point(const mechanics::CriticalPoint& point, std::vector<double>& row);

/// Lines of the results and counters of the manifest; `energy` is the unit of V.
void report_search(const mechanics::CriticalPoints& found, double energy, const RunContext& context,
                   ModelOutcome& outcome);

}  // namespace pseudorigid::app
