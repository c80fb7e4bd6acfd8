#pragma once
/// Eight runs of a sweep at the same time, one run in each lane of SIMD vectors (reduced/motions_in_lanes.h).

#include <optional>
#include <span>
#include <vector>

#include "app/run/run_context.h"

namespace pseudorigid::app {

/// Runs eight contexts together, writes their rows into their sinks, and returns their outcomes. For Time/Method = auto
/// the method is symmetric-8. All eight runs use the same step. It is Time/Step if the scene sets a method and a step,
/// otherwise the step that the run with the largest error needs.
///
/// Returns an empty value if the runs must be computed one by one, for example if there are not eight contexts. In runs
/// that are computed together, the bodies must be incompressible, and only the stress of the law may act on them. Law,
/// method, tolerance, step and times must be equal, and the method must be offered in lanes (reduced::moves_in_lanes).
/// A suitable step must exist. All motions must reach their end with finite rows, and the step must be stable for all
/// of them.
std::optional<std::vector<ModelOutcome>> run_reduced_in_lanes(std::span<const RunContext> contexts);

}  // namespace pseudorigid::app
