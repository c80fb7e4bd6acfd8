#pragma once
/// Writer of unstructured grids in VTK's XML format for ParaView: file version 1.0, one piece, coordinates and fields
/// as Float64, appended arrays compressed by zlib. Equal grids give equal files. A test checks that VTK and meshio read
/// the same data from a file (tests/support/check_vtu.py).

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace pseudorigid::io {

/// Types of cells, with the numbers of VTK.
enum class CellType : std::uint8_t { triangle = 5, quad = 9, hexahedron = 12, lagrange_hexahedron = 72 };

/// A grid of cells of one type, with fields of values at its points.
struct UnstructuredGrid {
  struct Field {
    std::string name;
    int n_components;            ///< numbers per point: 1 for a scalar, 3 for a vector, 9 for a tensor (row by row)
    std::vector<double> values;  ///< point by point; a constant has n_components numbers
  };
  std::vector<double> points{};  ///< coordinates x, y, z of each point
  CellType cell_type = CellType::hexahedron;
  int nodes_per_cell = 8;
  std::vector<std::int64_t> connectivity{};  ///< nodes_per_cell point numbers per cell, in VTK's order
  std::vector<Field> fields{};
  std::vector<Field> constants{};  ///< constants of the whole grid; ParaView uses the constant TimeValue as the time

  std::size_t n_points() const { return points.size() / 3; }
  std::size_t n_cells() const { return connectivity.size() / nodes_per_cell; }
};

/// Writes the grid to a file. The new file replaces an old file atomically. Throws WriteError if the file cannot be
/// written. Throws std::logic_error if the sizes of arrays do not match, if a point number is out of range, or if a
/// value is not finite.
void write_vtu(const std::filesystem::path& path, const UnstructuredGrid& grid);

/// Writes the .pvtu file of a picture of a parallel run. This file lists the .vtu files of the pieces (`files`), one of
/// each rank. All pieces must have the fields of `piece` and must be in the folder of the .pvtu file. Only the names of
/// the fields and their numbers of components are read from `piece`. Throws WriteError if the file cannot be written.
void write_pvtu(const std::filesystem::path& path, const UnstructuredGrid& piece,
                const std::vector<std::filesystem::path>& files);

}  // namespace pseudorigid::io
