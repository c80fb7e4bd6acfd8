#pragma once
/// Requests to stop a run, as a flag that the time loop polls after each step: Ctrl-C and SIGTERM (a second one kills
/// at once), a lost terminal or connection (SIGHUP), and a limit of processor time (SIGXCPU).

namespace pseudorigid::io {

/// SIGHUP stays ignored if nohup has asked for it. Also ignores SIGXFSZ, so that a file-size limit becomes a
/// WriteError like a full disk, and SIGPIPE: a run does not stop when the reader of its terminal output goes away.
void install_signal_handlers();

bool interrupt_requested() noexcept;

}  // namespace pseudorigid::io
