#pragma once
/// The lock of a run directory, which ensures that only one run at a time uses the directory. The lock is the file
/// `run.lock` in the directory. The file identifies the run by the host, the machine and its last start, and by the
/// number, namespace and start of the process. The run removes the file at its end.
///
/// A killed run does not remove the file. The next run on the same host replaces the lock if the process of the killed
/// run does not exist, or if another process now has its number. A zombie counts as a process that does not exist. The
/// next run also replaces the lock after a restart of the machine. The file /etc/machine-id distinguishes machines with
/// the same name. A run cannot check processes on another host or in another container. In this case the run stops with
/// a message that names the file, and the user decides whether to remove the file.

#include <filesystem>
#include <string>

namespace pseudorigid::io {

class RunLock {
 public:
  static constexpr const char* file_name = "run.lock";

  /// Locks the directory. Throws UserError if another run has locked the directory and has not ended, or if it is not
  /// known whether it has ended. The lock of the other run then remains. Throws WriteError if the lock cannot be
  /// written.
  explicit RunLock(const std::filesystem::path& directory);
  /// Removes the file `run.lock`, unless the user or another run has replaced it. Ignores errors.
  ~RunLock();
  RunLock(RunLock&& other) noexcept;
  RunLock& operator=(RunLock&&) = delete;

  /// Removes the file `run.lock` of a directory, and ignores errors. A rank that does not have the RunLock calls this
  /// function if it aborts the run.
  static void remove(const std::filesystem::path& directory) noexcept;

 private:
  bool create() const;
  void remove_if_stale() const;

  std::filesystem::path path_;
  std::string identity_;  ///< contents of the file; empty if another object has taken the lock by a move
};

}  // namespace pseudorigid::io
