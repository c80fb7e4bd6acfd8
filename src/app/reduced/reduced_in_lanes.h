#pragma once
/// Runs of a sweep eight at a time, one to a lane of a SIMD vector (reduced/motions_in_lanes.h).

#include <optional>
#include <span>
#include <vector>

#include "app/run/run_context.h"

namespace pseudorigid::app {

/// How the runs of these contexts ended, their rows being in their sinks; nothing if each has to run by itself: they
/// are not eight of equal law, times, tolerance and method of incompressible bodies without other forces than those of
/// the law, or one of them does not get to its end, or the step is set by stability.
///
/// Method = auto takes symmetric-8. All eight have the step that the one with the largest error asks for.
std::optional<std::vector<ModelOutcome>> run_reduced_in_lanes(std::span<const RunContext> contexts);

}  // namespace pseudorigid::app
