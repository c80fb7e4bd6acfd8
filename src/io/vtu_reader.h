#pragma once
/// Reader for the .vtu files that write_vtu writes. The report of a run reads the pictures with this function.

#include <filesystem>
#include <span>
#include <string>

#include "io/vtu.h"

namespace pseudorigid::io {

/// Reads the grid, its constants, and each of the given fields that the file contains. A missing field is not an error.
/// Throws UserError if the file cannot be read, does not have the form that write_vtu writes, or does not have a cell.
/// Also throws UserError if the byte order of the file is not that of this machine.
UnstructuredGrid read_vtu(const std::filesystem::path& path, std::span<const std::string> fields);

}  // namespace pseudorigid::io
