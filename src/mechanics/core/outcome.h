#pragma once

namespace pseudorigid::mechanics {

/// The outcome of a run. The time loop, the manifest and the exit code use it.
enum class Outcome { finished, interrupted, failed };

}  // namespace pseudorigid::mechanics
