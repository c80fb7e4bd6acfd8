#pragma once
/// Check of the stack limit of the process (ulimit -s).

namespace pseudorigid::app {

/// Throws std::system_error if the limit is less than the 512 kB that the program needs. With a lower limit, the
/// operating system would kill the program later without a message. Does nothing if the limit cannot be read.
void require_stack();

}  // namespace pseudorigid::app
