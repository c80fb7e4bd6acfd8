#pragma once
/// Check of the stack limit of the process (ulimit -s).

namespace pseudorigid::app {

/// Throws std::system_error if the limit is below the need of the program; the system would kill the program later.
void require_stack();

}  // namespace pseudorigid::app
