#pragma once

namespace pseudorigid::mechanics {

/// The end of a run. `finished`: it reached its end time. `interrupted`: the user stopped it, and it can be resumed.
/// `failed`: a step failed, and Status has the reason.
enum class Outcome { finished, interrupted, failed };

}  // namespace pseudorigid::mechanics
