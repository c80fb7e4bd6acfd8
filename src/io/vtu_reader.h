#pragma once
/// Reads back the grids that write_vtu writes, for pictures of a run that is finished.

#include <filesystem>
#include <span>
#include <string>

#include "io/vtu.h"

namespace pseudorigid::io {

/// The grid with those of the named fields that the file has, and with all constants of the grid.
/// UserError if the file cannot be read, or if write_vtu did not write it on a machine of this byte order.
UnstructuredGrid read_vtu(const std::filesystem::path& path, std::span<const std::string> fields);

}  // namespace pseudorigid::io
