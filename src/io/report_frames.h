#pragma once
/// Faces of a body for a report, read from the pictures of a run (`<model>.pvd`). The faces are on the surface and on
/// the coordinate planes of the undeformed body. A face consists of (p + 1)² material points of a block or element of
/// degree p.

#include <filesystem>
#include <string>
#include <vector>

#include "io/vtu.h"
#include "mechanics/core/shape_columns.h"

namespace pseudorigid::io {

struct PictureFace {
  int plane;                                        ///< 0: surface; 1, 2, 3: coordinate plane with normal x, y, z
  std::vector<std::pair<int, std::size_t>> points;  ///< index of the grid and number of its point, row by row
};

/// Finds the faces on the surface and on the coordinate planes of a body. The body consists of the grids `pieces`. If
/// two elements share a face on a plane, the result contains it once, with the points of the first element. The result
/// is empty if a grid does not consist of complete blocks of hexahedra (block_cells.h), or does not have the field
/// reference_coordinates.
std::vector<PictureFace> faces_of(const std::vector<UnstructuredGrid>& pieces);

/// A table with the columns of shapes.csv and the additional column `von_mises`. The table contains the faces at up to
/// eight times of pictures. For a body with the motion x = QX with a matrix Q (`is_affine`), the table contains one
/// point at the times of all pictures. The table is empty if there are no pictures, or if a file cannot be read. It is
/// also empty if the pictures do not have the fields reference_coordinates and von_mises, or if their faces have more
/// than 30000 points.
std::string table_of_frames(const std::filesystem::path& pvd, bool is_affine);

}  // namespace pseudorigid::io
