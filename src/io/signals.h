#pragma once
/// A flag for requests to stop a run, which the time loop reads after each step. The signals of Ctrl-C (SIGINT) and
/// SIGTERM set it; a second one ends the program at once. A lost terminal or connection (SIGHUP) and a limit of
/// processor time (SIGXCPU) also set it.

namespace pseudorigid::io {

/// Installs the handlers. SIGHUP remains ignored if the program was started by nohup. SIGXFSZ is ignored, so that a
/// limit on the size of a file becomes a WriteError. SIGPIPE is ignored, so that the run continues if the reader of its
/// terminal output ends.
void install_signal_handlers();

bool interrupt_requested() noexcept;

}  // namespace pseudorigid::io
