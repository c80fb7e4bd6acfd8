#pragma once
/// Ctrl-C and SIGTERM as a flag that the time loop polls after each step; a second one kills at once.

namespace pseudorigid::io {

/// Also ignores SIGXFSZ, so that a file-size limit becomes a WriteError like a full disk.
void install_signal_handlers();

bool interrupt_requested() noexcept;

}  // namespace pseudorigid::io
