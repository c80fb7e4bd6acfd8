#pragma once

namespace pseudorigid::mechanics {

/// How a run ended, from the time loop to the manifest and the exit code.
enum class Outcome { finished, interrupted, failed };

}  // namespace pseudorigid::mechanics
