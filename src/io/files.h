#pragma once
/// Whole files, read at once and replaced atomically, and the error of a write that the machine refused.

#include <filesystem>
#include <initializer_list>
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

/// Writes the concatenated parts to `path`.partial and renames it: a reader sees the old file or the new one, never a
/// mixture, and after a WriteError the old one is still there. No fsync: this guards against a killed program and a
/// full disk, not against a power cut.
void write_file_atomically(const std::filesystem::path& path, std::initializer_list<std::string_view> parts);

/// The whole file; a UserError names the path and the reason.
std::string read_file(const std::filesystem::path& path);

/// write(2) until everything is on its way; throws WriteError naming `path`.
void write_fully(int file_descriptor, std::string_view bytes, const std::filesystem::path& path);

}  // namespace pseudorigid::io
