#include "io/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "scene/user_error.h"

namespace pseudorigid::io {

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

namespace {

/// The partial file; removed unless it reached its final name.
class PartialFile {
 public:
  explicit PartialFile(const std::filesystem::path& target) : target_(target), partial_(target) {
    partial_ += partial_suffix;
    file_descriptor_ = ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file_descriptor_ < 0) throw WriteError(target_, errno);
  }
  ~PartialFile() {
    if (file_descriptor_ >= 0) ::close(file_descriptor_);
    if (!committed_) ::unlink(partial_.c_str());
  }
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  void write(std::string_view bytes) { write_fully(file_descriptor_, bytes, target_); }
  void commit() {
    const int close_result = ::close(std::exchange(file_descriptor_, -1));  // a network disk tells here that it is full
    if (close_result != 0 || std::rename(partial_.c_str(), target_.c_str()) != 0) throw WriteError(target_, errno);
    committed_ = true;
  }

 private:
  std::filesystem::path target_, partial_;
  int file_descriptor_ = -1;
  bool committed_ = false;
};

}  // namespace

void write_file_atomically(const std::filesystem::path& path, std::initializer_list<std::string_view> parts) {
  PartialFile file(path);
  for (const std::string_view part : parts) file.write(part);
  file.commit();
}

std::string read_file(const std::filesystem::path& path) {
  const auto fail = [&](int error_number) -> UserError {
    return UserError(fmt::format("cannot read '{}': {}", path.native(), std::strerror(error_number)));
  };
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) throw fail(errno);
  std::string content;
  char buffer[1 << 16];
  errno = 0;
  while (const std::size_t n_read = std::fread(buffer, 1, sizeof buffer, file)) content.append(buffer, n_read);
  const int error_number = std::ferror(file) ? errno : 0;
  std::fclose(file);
  if (error_number != 0) throw fail(error_number);
  return content;
}

}  // namespace pseudorigid::io
