#pragma once
/// The lock of a results directory, which belongs to one run at a time. The file `run.lock` names the owner by host,
/// process and start of the process. It exists while the run is in progress and is removed when the run ends.
///
/// A killed run leaves the file behind. The next run on the same host takes over the lock if the process has ended or
/// its number belongs to another process. It also takes over the lock after a restart of the machine; /etc/machine-id
/// distinguishes machines with the same name. A run cannot check processes on another host. It then stops with a
/// message that names the file, and the user decides whether to remove it.

#include <filesystem>
#include <string>

namespace pseudorigid::io {

class RunLock {
 public:
  static constexpr const char* file_name = "run.lock";

  /// UserError if another run has locked the directory; the directory is then unchanged. WriteError if the lock cannot
  /// be written.
  explicit RunLock(const std::filesystem::path& directory);
  ~RunLock();
  RunLock(RunLock&& other) noexcept;
  RunLock& operator=(RunLock&&) = delete;

  /// A rank that does not hold the lock calls this function if it aborts the run.
  static void remove(const std::filesystem::path& directory) noexcept;

 private:
  bool create() const;
  void remove_if_stale() const;

  std::filesystem::path path_;
  std::string identity_;  ///< contents of the file; empty after the lock has been moved to another object
};

}  // namespace pseudorigid::io
