#pragma once

namespace pseudorigid::mechanics {

/// The outcome of a run. A `finished` run reached its end time. An `interrupted` run was stopped by the caller. In a
/// `failed` run, a step or a sample failed.
enum class Outcome { finished, interrupted, failed };

}  // namespace pseudorigid::mechanics
