#pragma once
/// Functions that read a whole file at once or replace a file atomically, and the exception for a failed write.

#include <filesystem>
#include <initializer_list>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace pseudorigid::io {

/// A failed write, for example to a full disk or a removed folder. After this error, a run cannot continue and ends
/// with exit code 3.
struct WriteError : std::runtime_error {
  /// The message contains the path and the text of the error number (strerror).
  WriteError(std::filesystem::path file, int error_number);
  std::filesystem::path path;
  int error_number;  ///< value of errno
};

/// Suffix of the name of an incomplete file. When the file is complete, it is renamed to a name without the suffix. A
/// killed run may leave an incomplete file.
inline constexpr std::string_view partial_suffix = ".partial";

/// An open file, which the destructor closes.
class Descriptor {
 public:
  /// Opens the file with `flags` of open(2) and additionally O_NONBLOCK, O_NOCTTY and O_CLOEXEC. Opening a pipe
  /// therefore does not wait for the other end. If opening fails, the object converts to false, and errno has the
  /// reason.
  Descriptor(const std::filesystem::path& path, int flags);
  ~Descriptor();
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int value() const { return value_; }
  explicit operator bool() const { return value_ >= 0; }
  /// Closes the file. Returns false if close(2) fails. A full network disk may report its error only at this call.
  bool close();

 private:
  int value_;
};

/// True if a file, folder or symbolic link has this path. The target of the link need not exist.
bool is_there(const std::filesystem::path& path);

/// Returns the kind of the file: "a named pipe", "a socket", "a device" or "a directory". The result is empty for a
/// regular file, and for a path that does not exist or cannot be examined. The kind of a link is the kind of its
/// target.
std::string kind_unless_file(const std::filesystem::path& path);

/// Writes the concatenated parts to the file `path`.partial and then renames this file to `path`. A reader therefore
/// sees either the complete old file or the complete new file. If writing fails, for example because the disk is full,
/// the function throws WriteError and the old file remains. The old file also remains if the program is killed before
/// the renaming. A power failure may damage the new file, because the function does not call fsync. If `path` is a
/// link, its target is replaced and the link remains. Pipes and devices are written directly. A pipe without a reader
/// causes a WriteError with the error number ENXIO.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::string_view> parts);
inline void write_file_atomically(const std::filesystem::path& path, std::initializer_list<std::string_view> parts) {
  write_file_atomically(path, std::span(parts.begin(), parts.size()));
}

/// The contents of a regular file. Throws UserError with the path and the reason if the file cannot be read.
/// Directories, pipes, sockets and devices also cause a UserError, because some pipes and devices never end.
std::string read_file(const std::filesystem::path& path);

/// Calls write(2) until all bytes are written, also after an interruption by a signal. If a call fails for another
/// reason, throws a WriteError that names `path`.
void write_fully(int file_descriptor, std::string_view bytes, const std::filesystem::path& path);

}  // namespace pseudorigid::io
