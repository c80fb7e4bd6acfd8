#pragma once
/// Check of the stack limit of the process (ulimit -s).

namespace pseudorigid::app {

/// Throws std::system_error if the limit is less than the program needs. Otherwise the operating system would kill the
/// program later.
void require_stack();

}  // namespace pseudorigid::app
