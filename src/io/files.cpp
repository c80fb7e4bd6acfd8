#include "io/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "scene/user_error.h"

namespace pseudorigid::io {

namespace fs = std::filesystem;

WriteError::WriteError(std::filesystem::path file, int error_number)
    : std::runtime_error(fmt::format("cannot write '{}': {}", file.native(), std::strerror(error_number))),
      path(std::move(file)),
      error_number(error_number) {}

void write_fully(int file_descriptor, std::string_view bytes, const std::filesystem::path& path) {
  while (!bytes.empty()) {
    const ssize_t n_written = ::write(file_descriptor, bytes.data(), bytes.size());
    if (n_written < 0 && errno == EINTR) continue;
    if (n_written < 0) throw WriteError(path, errno);
    bytes.remove_prefix(n_written);
  }
}

Descriptor::Descriptor(const fs::path& path, int flags)
    : value_(::open(path.c_str(), flags | O_NONBLOCK | O_NOCTTY | O_CLOEXEC, 0666)) {}

Descriptor::~Descriptor() {
  if (value_ >= 0) ::close(value_);
}

bool Descriptor::close() { return ::close(std::exchange(value_, -1)) == 0; }

bool is_there(const fs::path& path) {
  std::error_code none;
  return fs::exists(fs::symlink_status(path, none));
}

namespace {

/// The kind of a file in words, such as "a device", for its mode from stat(2). The result is empty for a regular file.
std::string kind_of(mode_t mode) {
  if (S_ISFIFO(mode)) return "a named pipe";
  if (S_ISSOCK(mode)) return "a socket";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "a device";
  return S_ISDIR(mode) ? "a directory" : "";
}

bool is_file(int file_descriptor) {
  struct stat status;
  return ::fstat(file_descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

/// The path at the end of the chain of symbolic links that starts at `path`. A file with the resulting path need not
/// exist. Throws WriteError if the chain has 40 links or more.
fs::path behind_links(fs::path path) {
  constexpr int most = 40;  // the limit of Linux for the links in a path
  for (int n = 0; n < most; ++n) {
    std::error_code is_no_link;
    const fs::path target = fs::read_symlink(path, is_no_link);
    if (is_no_link) return path;
    path = path.parent_path() / target;
  }
  throw WriteError(path, ELOOP);
}

/// The file `target`.partial, which `commit` renames to `target`. Without a successful `commit`, the destructor removes
/// the file. The constructor and the functions throw WriteError with the path `target` if they fail. The constructor
/// also throws WriteError if `target`.partial exists and is not a regular file.
class PartialFile {
 public:
  explicit PartialFile(const fs::path& target)
      : target_(target), partial_(target.native() + std::string(partial_suffix)), file_(partial_, flags) {
    if (!file_) throw WriteError(target_, errno);
    if (!is_file(file_.value())) throw WriteError(target_, EEXIST);
    owns_ = true;
  }
  ~PartialFile() {
    if (owns_) ::unlink(partial_.c_str());
  }
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  void write(std::string_view bytes) { write_fully(file_.value(), bytes, target_); }
  void commit() {
    if (!file_.close() || std::rename(partial_.c_str(), target_.c_str()) != 0) throw WriteError(target_, errno);
    owns_ = false;
  }

 private:
  static constexpr int flags = O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW;
  fs::path target_, partial_;
  Descriptor file_;
  bool owns_ = false;
};

/// Writes the parts into an existing pipe or device. Throws WriteError if this fails, for example for a pipe without a
/// reader.
void write_into(const fs::path& path, std::span<const std::string_view> parts) {
  Descriptor file(path, O_WRONLY);
  // F_SETFL removes O_NONBLOCK, so that a write waits for the reader.
  if (!file || ::fcntl(file.value(), F_SETFL, 0) != 0) throw WriteError(path, errno);
  for (const std::string_view part : parts) write_fully(file.value(), part, path);
  if (!file.close()) throw WriteError(path, errno);
}

}  // namespace

std::string kind_unless_file(const fs::path& path) {
  struct stat status;
  return ::stat(path.c_str(), &status) == 0 ? kind_of(status.st_mode) : "";
}

void write_file_atomically(const fs::path& path, std::span<const std::string_view> parts) {
  struct stat status;
  if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode))
    return write_into(path, parts);
  PartialFile file(behind_links(path));
  for (const std::string_view part : parts) file.write(part);
  file.commit();
}

std::string read_file(const fs::path& path) {
  const auto fail = [&](const std::string& reason) {
    return UserError(fmt::format("cannot read '{}': {}", path.native(), reason));
  };
  if (const std::string kind = kind_unless_file(path); !kind.empty()) throw fail("expected a file, this is " + kind);
  const Descriptor file(path, O_RDONLY);
  if (!file) throw fail(std::strerror(errno));
  std::string content;
  char buffer[1 << 16];
  while (const ssize_t n_read = ::read(file.value(), buffer, sizeof buffer)) {
    if (n_read < 0 && errno == EINTR) continue;
    if (n_read < 0) throw fail(std::strerror(errno));
    content.append(buffer, static_cast<std::size_t>(n_read));
  }
  return content;
}

}  // namespace pseudorigid::io
