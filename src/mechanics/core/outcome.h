#pragma once

namespace pseudorigid::mechanics {

/// The outcome of a run. `finished`: the run reached its end time. `interrupted`: the caller stopped the run before its
/// end. `failed`: a step or a sample of the run failed.
enum class Outcome { finished, interrupted, failed };

}  // namespace pseudorigid::mechanics
