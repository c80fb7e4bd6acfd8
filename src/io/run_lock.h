#pragma once
/// The lock of a run directory. It ensures that only one run at a time uses the directory. The file `run.lock`
/// identifies the run by host, process and start of the process. The file is removed when the run ends.
///
/// A killed run does not remove the file. The next run on the same host takes over the lock if the process has ended,
/// or if another process now has its number. It also takes over the lock after a restart of the machine. The file
/// /etc/machine-id distinguishes machines with the same name. A run cannot check processes on another host or in
/// another container. In this case the run stops with a message that names the file, and the user decides whether to
/// remove the file.

#include <filesystem>
#include <string>

namespace pseudorigid::io {

class RunLock {
 public:
  static constexpr const char* file_name = "run.lock";

  /// Locks the directory. Throws UserError if another run has locked it, or if it is not known whether the other run
  /// has ended; the directory is then unchanged. Throws WriteError if the lock cannot be written.
  explicit RunLock(const std::filesystem::path& directory);
  /// Removes the lock, unless the user or another run has replaced the file. Ignores errors.
  ~RunLock();
  RunLock(RunLock&& other) noexcept;
  RunLock& operator=(RunLock&&) = delete;

  /// Removes the lock of a directory, and ignores errors. A rank that does not hold the lock calls this function if it
  /// aborts the run.
  static void remove(const std::filesystem::path& directory) noexcept;

 private:
  bool create() const;
  void remove_if_stale() const;

  std::filesystem::path path_;
  std::string identity_;  ///< contents of the file; empty if the lock has been moved to another object
};

}  // namespace pseudorigid::io
