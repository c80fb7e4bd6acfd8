#pragma once
/// Eight runs of a sweep at the same time, one run in each lane of SIMD vectors (reduced/motions_in_lanes.h).

#include <optional>
#include <span>
#include <vector>

#include "app/run/run_context.h"

namespace pseudorigid::app {

/// Runs eight contexts together, writes their rows into their sinks, and returns their outcomes. For Time/Method = auto
/// the method is symmetric-8. All eight runs use the same step. If the scenes set a method and Time/Step, it is
/// Time/Step. Otherwise it is the step that the run with the largest error needs, but at most Time/Step.
///
/// Returns an empty value if the runs cannot be computed together; a caller must then compute each run separately. Some
/// sinks may then already have rows. There must be eight contexts. The bodies must be incompressible, and only the
/// stress of the law may act on them. Law, method, tolerance, Time/Step, Time/End and the number of samples must be
/// equal, with times in internal units. The method must be offered in lanes (reduced::moves_in_lanes). A suitable step
/// must exist. All motions must reach their end with finite rows, and the step must be stable for all of them.
std::optional<std::vector<ModelOutcome>> run_reduced_in_lanes(std::span<const RunContext> contexts);

}  // namespace pseudorigid::app
