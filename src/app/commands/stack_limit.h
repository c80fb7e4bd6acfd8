#pragma once
/// The limit of a process's stack (ulimit -s).

namespace pseudorigid::app {

/// Throws std::system_error if the stack may not grow as far as the program needs: the system would kill it on the way.
void require_stack();

}  // namespace pseudorigid::app
