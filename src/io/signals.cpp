#include "io/signals.h"

#include <atomic>
#include <csignal>

namespace pseudorigid::io {

namespace {

std::atomic<bool> requested = false;
static_assert(std::atomic<bool>::is_always_lock_free);  // a signal handler may only use lock-free atomics

extern "C" void request_interrupt(int) { requested.store(true, std::memory_order_relaxed); }

/// Installs the handler for a signal. `flags` contains flags of sigaction(2) in addition to SA_RESTART, which makes
/// interrupted system calls continue.
void listen_to(int signal, unsigned int flags) {
  struct sigaction action = {};
  action.sa_handler = request_interrupt;
  action.sa_flags = static_cast<int>(flags | SA_RESTART);
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

}  // namespace

void install_signal_handlers() {
  // SA_RESETHAND restores the default action of a signal after its first arrival. A second Ctrl-C therefore ends the
  // process at once.
  for (const int signal : {SIGINT, SIGTERM}) listen_to(signal, SA_RESETHAND);
  // A second SIGHUP or SIGXCPU must not end the run at once. The kernel and the shell may both send SIGHUP, and the
  // kernel sends SIGXCPU every second.
  struct sigaction hangup = {};
  sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN) listen_to(SIGHUP, 0);
  listen_to(SIGXCPU, 0);
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

bool interrupt_requested() noexcept { return requested.load(std::memory_order_relaxed); }

}  // namespace pseudorigid::io
