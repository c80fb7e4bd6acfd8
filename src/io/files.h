#pragma once
/// Whole files, read at once and replaced atomically, and the error of a write that the machine refused.

#include <filesystem>
#include <initializer_list>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace pseudorigid::io {

/// The disk is full, the device failed, the folder vanished: the computation cannot go on (exit code 3).
struct WriteError : std::runtime_error {
  WriteError(std::filesystem::path file, int error_number);
  std::filesystem::path path;
  int error_number;  ///< errno
};

/// Suffix of the file that is written first and then renamed; a killed run can leave one behind.
inline constexpr std::string_view partial_suffix = ".partial";

/// A file that is closed at the end of its scope.
class Descriptor {
 public:
  /// As open(2). The call does not wait for a pipe without a reader.
  Descriptor(const std::filesystem::path& path, int flags);
  ~Descriptor();
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int value() const { return value_; }
  explicit operator bool() const { return value_ >= 0; }
  /// False if close(2) fails: a network disk tells there that it is full.
  bool close();

 private:
  int value_;
};

/// Whether the path exists; a link that leads nowhere exists.
bool is_there(const std::filesystem::path& path);

/// "a named pipe", "a socket", "a device", "a directory"; empty for a file, for a link to a file, and if the path does
/// not exist.
std::string kind_unless_file(const std::filesystem::path& path);

/// Writes the concatenated parts to `path`.partial and renames it: a reader sees the old file or the new one, never a
/// mixture, and after a WriteError the old one is still there. No fsync: this guards against a killed program and a
/// full disk, not against a power cut. A link is kept, and its target is replaced. Pipes and devices are written
/// into; a pipe without a reader is ENXIO.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::string_view> parts);
inline void write_file_atomically(const std::filesystem::path& path, std::initializer_list<std::string_view> parts) {
  write_file_atomically(path, std::span(parts.begin(), parts.size()));
}

/// The whole file; a UserError names the path and the reason. Pipes and devices are refused: some never end.
std::string read_file(const std::filesystem::path& path);

/// write(2) until everything is on its way; throws WriteError naming `path`.
void write_fully(int file_descriptor, std::string_view bytes, const std::filesystem::path& path);

}  // namespace pseudorigid::io
