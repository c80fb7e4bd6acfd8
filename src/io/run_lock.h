#pragma once
/// A results directory belongs to one run at a time. The file `run.lock` in it names the owner: host, process and the
/// start of the process. It exists while the run is at work and is removed at its end, however it ends. A killed run
/// leaves it behind; the next run on that host sees that the process is gone, or that its number belongs to another
/// process, and takes over the lock. So it does after a new start of the machine, which /etc/machine-id tells from
/// another one of the same name. Processes on another host cannot be seen: the refusal names the file, and the user
/// decides.

#include <filesystem>
#include <string>

namespace pseudorigid::io {

class RunLock {
 public:
  static constexpr const char* file_name = "run.lock";

  /// UserError if another run has the directory; the directory is not changed then. WriteError if the lock cannot be
  /// written.
  explicit RunLock(const std::filesystem::path& directory);
  ~RunLock();
  RunLock(RunLock&& other) noexcept;
  RunLock& operator=(RunLock&&) = delete;

  /// Called by a rank that aborts the run without holding the lock.
  static void remove(const std::filesystem::path& directory) noexcept;

 private:
  bool create() const;
  void remove_if_stale() const;

  std::filesystem::path path_;
  std::string identity_;  ///< contents of the file; empty after the lock has been given to another object
};

}  // namespace pseudorigid::io
