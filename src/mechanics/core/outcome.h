#pragma once

namespace pseudorigid::mechanics {

/// The outcome of a run. `finished`: it reached its end time. `interrupted`: the caller stopped it before its end.
/// `failed`: a step failed.
enum class Outcome { finished, interrupted, failed };

}  // namespace pseudorigid::mechanics
