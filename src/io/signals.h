#pragma once
/// A flag for requests to stop a run. Loops over time steps and over the runs of a sweep read the flag regularly, and
/// stop if it is set. The signals SIGINT (Ctrl-C) and SIGTERM set the flag. A second signal of the same kind ends the
/// program at once. SIGHUP (lost terminal or connection) and SIGXCPU (limit of processor time) set the flag each time.

namespace pseudorigid::io {

/// Installs the signal handlers of the process. SIGHUP remains ignored if nohup started the program. SIGXFSZ is
/// ignored, so that a limit on the size of a file causes a WriteError. SIGPIPE is ignored, so that the run continues if
/// a program that reads its standard output ends.
void install_signal_handlers();

/// True if SIGINT, SIGTERM, SIGHUP or SIGXCPU has set the flag.
bool interrupt_requested() noexcept;

}  // namespace pseudorigid::io
