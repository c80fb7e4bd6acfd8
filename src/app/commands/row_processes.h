#pragma once
/// Runs of a sweep in processes of their own, for models whose libraries serve one thread of a process. Each thread of
/// the sweep has a process, which makes one row after the other. A process ends with the one that started it.

#include <sys/types.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "app/commands/sweep_task.h"

namespace pseudorigid::app {

/// A copy of this process that makes rows of `task`. Both ends of the pipes are closed at the end.
class RowProcess {
 public:
  /// Throws std::system_error. No other thread may run.
  explicit RowProcess(const SweepTask& task);
  ~RowProcess();
  RowProcess(const RowProcess&) = delete;
  RowProcess& operator=(const RowProcess&) = delete;

  /// Throws the exception that `task` throws there. UserError and std::bad_alloc keep their type, others become
  /// std::runtime_error with the same sentence. The end of the process is a std::runtime_error as well.
  FinishedRun run(int k);

 private:
  [[noreturn]] static void serve(const SweepTask& task, int requests, int answers);
  bool receive(void* data, std::size_t size);
  [[noreturn]] void report_end(int k);

  int to_ = -1, from_ = -1;
  pid_t process_ = -1;
};

/// A task whose runs are made by such processes, at most `n_processes` at a time.
class TaskInProcesses : public SweepTask {
 public:
  TaskInProcesses(const SweepTask& task, int n_processes);

  std::vector<std::string> columns() const override { return task_.columns(); }
  FinishedRun run(int k) const override;

 private:
  const SweepTask& task_;
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<RowProcess>> idle_;
};

}  // namespace pseudorigid::app
