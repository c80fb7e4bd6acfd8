#pragma once
/// The discretisation error of a run, estimated by a companion run on a coarser discretisation (scene/discretization.h)
/// with the same method and step, so that time errors cancel (analysis/space_error.h).
///
/// Counters: estimated_space_error (largest entry of Q), relative_space_error (|Q − Q'|/|Q|), companion_degree,
/// companion_refinements, companion_work.

#include "app/search/continuum_run.h"

namespace pseudorigid::app {

/// The scene's fixed discretisation, and its companion if the scene needs it.
ModelOutcome run_with_estimate(const RunContext& context, const ContinuumRun& run);

}  // namespace pseudorigid::app
