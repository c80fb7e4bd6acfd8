#pragma once
/// A flag for requests to stop a run. The loop in time reads the flag after each step. The signals SIGINT (Ctrl-C) and
/// SIGTERM set the flag; a second such signal ends the program at once. SIGHUP (lost terminal or connection) and
/// SIGXCPU (limit of processor time) also set the flag.

namespace pseudorigid::io {

/// Installs the signal handlers. SIGHUP remains ignored if nohup started the program. SIGXFSZ is ignored. A limit on
/// the size of a file then causes a WriteError. SIGPIPE is ignored. The run then continues if the reader of its
/// terminal output ends.
void install_signal_handlers();

bool interrupt_requested() noexcept;

}  // namespace pseudorigid::io
