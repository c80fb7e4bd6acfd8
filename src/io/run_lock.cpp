#include "io/run_lock.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <ctime>
#include <fstream>
#include <map>
#include <sstream>
#include <utility>

#include "io/files.h"
#include "scene/user_error.h"

namespace pseudorigid::io {
namespace {

namespace fs = std::filesystem;

using Identity = std::map<std::string, std::string>;

/// Names of the lines in the file of the lock. The line `since` has the time of the lock, for messages. The other lines
/// together identify a process. The line `numbering` identifies the namespace of process numbers, which is different in
/// a container. The number of a process is not sufficient, because another process may have the same number later, in
/// another container, or after a restart of the machine.
constexpr const char *host = "host", *machine = "machine", *boot = "boot", *numbering = "numbering",
                     *process = "process", *process_start = "process start", *since = "since";

std::string host_name() {
  char name[256] = {};
  return ::gethostname(name, sizeof name - 1) == 0 ? name : "";
}

std::string first_line(const fs::path& path) {
  std::string line;
  std::ifstream file(path);
  std::getline(file, line);
  return line;
}

struct ProcessState {
  char state = 0;     ///< letter of the state in proc(5), for example Z for a zombie; 0 if it is not known
  std::string start;  ///< start of the process, in clock ticks since the start of the machine
};

/// State and start of a process, from the fields 3 and 22 of /proc/<process>/stat. If this file cannot be read, the
/// state is 0. Field 2 is the name of the program in parentheses, and this name may contain any character. The search
/// for the fields therefore begins after the last parenthesis.
ProcessState state_of(const std::string& process) {
  const std::string line = first_line("/proc/" + process + "/stat");
  const std::size_t name_end = line.rfind(')');
  if (name_end == line.npos) return {};
  std::istringstream fields(line.substr(name_end + 1));
  ProcessState result;
  fields >> result.state;
  for (int field = 4; field <= 22; ++field) fields >> result.start;
  return result;
}

Identity own_identity() {
  const std::string number = std::to_string(::getpid());
  std::error_code ignored;
  return {{host, host_name()},
          {machine, first_line("/etc/machine-id")},
          {boot, first_line("/proc/sys/kernel/random/boot_id")},
          {numbering, fs::read_symlink("/proc/self/ns/pid", ignored).native()},
          {process, number},
          {process_start, state_of("self").start},
          {since, fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(std::time(nullptr)))}};
}

std::string to_text(const Identity& identity) {
  std::string text;
  for (const auto& [name, value] : identity) text += fmt::format("{}: {}\n", name, value);
  return text;
}

Identity from_text(const std::string& text) {
  Identity identity;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (const std::size_t colon = line.find(": "); colon != line.npos)
      identity[line.substr(0, colon)] = line.substr(colon + 2);
  return identity;
}

/// State of the run that has a lock. The state is unknown if this process cannot see the processes of that run, or if
/// the file of the lock is incomplete or cannot be read.
enum class Judgement { at_work, ended, unknown };

/// The state of the run with the identity `holder`. The run has ended if its machine was restarted, or if its process
/// does not exist or is a zombie. It has also ended if its process number now belongs to another process.
Judgement judge(Identity holder) {
  Identity own = own_identity();
  if (holder[host].empty() || holder[host] != own[host]) return Judgement::unknown;
  if (holder[numbering] != own[numbering]) return Judgement::unknown;
  if (holder[boot] != own[boot]) {
    // The boot identifier changes if this machine is restarted. It is also different on another machine with the same
    // name, such as a container or a copy of a virtual machine.
    const bool is_this_machine = !own[machine].empty() && holder[machine] == own[machine];
    return is_this_machine ? Judgement::ended : Judgement::unknown;
  }
  const long number = std::strtol(holder[process].c_str(), nullptr, 10);
  if (number <= 0) return Judgement::unknown;
  if (::kill(static_cast<pid_t>(number), 0) != 0 && errno == ESRCH) return Judgement::ended;
  const ProcessState found = state_of(holder[process]);
  if (found.state == 0) return Judgement::at_work;  // the process exists, but this user may not read its data
  const bool is_zombie = found.state == 'Z' || found.state == 'X';
  return is_zombie || found.start != holder[process_start] ? Judgement::ended : Judgement::at_work;
}

/// The error about a lock of another run that has not ended, or may not have ended. Its text names the process of the
/// run, or the file that the user can remove.
UserError in_use(const fs::path& lock, Identity holder, Judgement judgement) {
  const std::string directory = lock.parent_path().native();
  if (judgement == Judgement::at_work)
    return UserError(fmt::format("another run is at work in the output directory '{}' (process {}, since {})",
                                 directory, holder[process], holder[since]));
  const std::string who = holder[host].empty() ? "by whom cannot be read"
                                               : fmt::format(
                                                     "process {} on host {}, since {}, which cannot be seen "
                                                     "from here",
                                                     holder[process], holder[host], holder[since]);
  return UserError(
      fmt::format("the output directory '{}' is locked by another run ({}); if that run has ended, remove '{}'",
                  directory, who, lock.native()));
}

bool same_file(const struct stat& a, const struct stat& b) { return a.st_dev == b.st_dev && a.st_ino == b.st_ino; }

}  // namespace

RunLock::RunLock(const fs::path& directory) : path_(directory / file_name), identity_(to_text(own_identity())) {
  // After `create` has found the lock of another run, this lock may disappear, and a third run may create a new lock.
  // Therefore the constructor tries again.
  constexpr int n_attempts = 100;
  for (int i = 0; i < n_attempts; ++i) {
    if (create()) return;
    remove_if_stale();
  }
  throw in_use(path_, {}, Judgement::unknown);
}

RunLock::RunLock(RunLock&& other) noexcept
    : path_(std::move(other.path_)), identity_(std::exchange(other.identity_, {})) {}

RunLock::~RunLock() {
  if (identity_.empty()) return;
  try {
    // The user may have removed the file, and another run may then have created a new file, which must remain.
    if (read_file(path_) == identity_) ::unlink(path_.c_str());
  } catch (const std::exception&) {
  }
}

void RunLock::remove(const fs::path& directory) noexcept { ::unlink((directory / file_name).c_str()); }

/// Creates the file of the lock and returns true. Returns false if this file already exists or if the temporary file
/// has disappeared; the caller then tries again. Throws WriteError if a file cannot be written. The contents are first
/// written to a temporary file, to which the name `run.lock` is then linked. The lock is therefore complete when it
/// appears, and only one process can create it, even on a network disk. On a disk without hard links, the file is
/// created with the name `run.lock`, and another process may briefly see an incomplete lock.
bool RunLock::create() const {
  const fs::path own = path_.native() + fmt::format("-{}-{}", host_name(), ::getpid()) + std::string(partial_suffix);
  struct Removal {
    const fs::path& path;
    ~Removal() { ::unlink(path.c_str()); }
  } const removal{own};
  {
    const Descriptor file(own, O_WRONLY | O_CREAT | O_TRUNC);
    if (!file) throw WriteError(path_, errno);
    write_fully(file.value(), identity_, path_);
  }
  if (::link(own.c_str(), path_.c_str()) == 0) return true;
  const int reason = errno;
  struct stat status;
  // A network disk may have created the link although link(2) reported an error.
  if (::stat(own.c_str(), &status) == 0 && status.st_nlink == 2) return true;
  if (reason == EEXIST || reason == ENOENT) return false;
  // The disk does not support hard links, so the file is created with the name of the lock.
  const Descriptor file(path_, O_WRONLY | O_CREAT | O_EXCL);
  if (!file && errno == EEXIST) return false;
  if (!file) throw WriteError(path_, errno);
  try {
    write_fully(file.value(), identity_, path_);
  } catch (...) {
    ::unlink(path_.c_str());
    throw;
  }
  return true;
}

/// Removes the lock of a run that has ended, and throws UserError for any other lock. Also throws UserError if the lock
/// cannot be read. Does nothing if the lock has disappeared. If several processes find the same lock, flock(2) lets one
/// process at a time continue. Each process then checks that its open file still has the name of the lock. If another
/// file has this name, the function does nothing.
void RunLock::remove_if_stale() const {
  if (!kind_unless_file(path_).empty()) throw in_use(path_, {}, Judgement::unknown);
  const Descriptor file(path_, O_RDWR);  // on network disks, flock requires a file that is open for writing
  if (!file && errno == ENOENT) return;
  if (!file || ::flock(file.value(), LOCK_EX) != 0) throw in_use(path_, {}, Judgement::unknown);
  struct stat opened, named;
  if (::fstat(file.value(), &opened) != 0 || ::stat(path_.c_str(), &named) != 0 || !same_file(opened, named)) return;
  const Identity holder = from_text(read_file(path_));
  const Judgement judgement = judge(holder);
  if (judgement != Judgement::ended) throw in_use(path_, holder, judgement);
  ::unlink(path_.c_str());
}

}  // namespace pseudorigid::io
