#pragma once
/// Reader for the grids that write_vtu writes. The report uses this reader for the pictures of a run.

#include <filesystem>
#include <span>
#include <string>

#include "io/vtu.h"

namespace pseudorigid::io {

/// Reads the grid, its constants, and each of the given fields that the file contains. A missing field is not an error.
/// Throws UserError if the file cannot be read, or if write_vtu did not write it on a machine with the same byte order.
UnstructuredGrid read_vtu(const std::filesystem::path& path, std::span<const std::string> fields);

}  // namespace pseudorigid::io
