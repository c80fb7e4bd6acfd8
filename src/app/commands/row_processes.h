#pragma once
/// Separate processes for the runs of a sweep, for models whose libraries support only one thread per process. Each
/// thread of the sweep uses one process, which computes one row after the other. These processes end if their parent
/// process ends.

#include <sys/types.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "app/commands/sweep_task.h"

namespace pseudorigid::app {

/// Owner of a child process, a copy (fork) of this process, which computes rows of `task`. The destructor closes the
/// pipes to the child process and kills it.
class RowProcess {
 public:
  /// The calling process must have a single thread. The child process has only a copy of the calling thread, so locks
  /// of other threads would remain locked there. Throws std::system_error if a pipe or the child process cannot be
  /// created.
  explicit RowProcess(const SweepTask& task);
  ~RowProcess();
  RowProcess(const RowProcess&) = delete;
  RowProcess& operator=(const RowProcess&) = delete;

  /// Computes the row of run k. Only one thread may call this function at a time. If `task` throws a UserError or
  /// std::bad_alloc in the child process, this function throws the same type. For other exceptions it throws
  /// std::runtime_error. Except for std::bad_alloc, the exception has the text of the original exception. If the child
  /// process ends without an answer, this function throws std::runtime_error.
  FinishedRun run(int k);

 private:
  /// Loop of the child process: reads the number of a run from `requests`, writes the answer to `answers`, and ends
  /// when a pipe closes.
  [[noreturn]] static void serve(const SweepTask& task, int requests, int answers);
  /// Reads `size` bytes of an answer. Returns false if the child process has ended. After an interrupt, sends SIGTERM
  /// to the child process, which then ends its run.
  bool receive(void* data, std::size_t size);
  /// Throws std::runtime_error with the reason why the child process ended before the answer for run k.
  [[noreturn]] void report_end(int k);

  int to_ = -1, from_ = -1;  ///< pipes: `to_` sends the numbers of runs, `from_` receives their answers
  pid_t process_ = -1;       ///< the child process; −1 after its end
};

/// A task that distributes the runs of `task` over `n_processes` child processes. At most `n_processes` threads may
/// call `run` at the same time. If more threads call `run`, it throws std::logic_error.
class TaskInProcesses : public SweepTask {
 public:
  /// Starts the child processes, so the calling process must have a single thread. `task` must exist as long as the
  /// object. Throws std::system_error if a child process cannot be created.
  TaskInProcesses(const SweepTask& task, int n_processes);

  std::vector<std::string> columns() const override { return task_.columns(); }
  FinishedRun run(int k) const override;

 private:
  const SweepTask& task_;
  mutable std::mutex mutex_;                               ///< protects idle_
  mutable std::vector<std::unique_ptr<RowProcess>> idle_;  ///< child processes that no thread uses now
};

}  // namespace pseudorigid::app
