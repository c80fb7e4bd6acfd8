#pragma once
/// The limit of a process's stack (ulimit -s).

namespace pseudorigid::app {

/// Throws std::system_error if the limit of the stack is below the need of the program: the system would kill it during
/// the run.
void require_stack();

}  // namespace pseudorigid::app
