#pragma once
/// Several degrees of one polynomial scene.
///
/// Degrees that the scene lists are run one after the other. The last writes polynomial.csv and is the model of the
/// scene; the others write `polynomial-<degree>.csv` and are compared with the reference as models of their own.
///
/// If the degree is left open (auto) the scene is run with N = 1, 3, 5, … for its trace alone. Even degrees add
/// nothing to motions with the symmetry of an octant, which go in steps of two. The differences of Q between successive
/// runs give the error of the last one (analysis/space_error.h, N being the resolution), and the first degree whose
/// error is within Polynomial/Tolerance is run for its results. That degree is kept in a checkpoint, so that a resumed
/// run repeats no search; a search that was interrupted is repeated. Time errors are kept to a twentieth of the
/// tolerance.
///
/// A body of a given degree that others are compared with has a companion of another degree (search/error_estimate.h).
///
/// Counters of the run: estimated_space_error, relative_space_error (|Q − Q'|/|Q|); of a search search_runs,
/// search_work; of a companion companion_degree, companion_work.

#include <functional>

#include "app/polynomial/body_setup.h"

namespace pseudorigid::app {

using PolynomialRun = std::function<ModelOutcome(const RunContext& context, const PolynomialTask& task)>;

inline constexpr const char* degree_checkpoint_name = "degree";

/// Runs a scene that gives one degree or several.
ModelOutcome run_listed_degrees(const RunContext& context, const PolynomialRun& run);

/// Runs a scene that leaves the degree open.
ModelOutcome run_degree_search(const RunContext& context, const PolynomialRun& run);

}  // namespace pseudorigid::app
