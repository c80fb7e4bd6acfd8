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
  int plane;  ///< 0: surface; 1, 2, 3: coordinate plane with normal x, y, z
  /// The points row by row, with p + 1 points in a row. A point is given by the index of its grid in the list of grids,
  /// and by its index in this grid.
  std::vector<std::pair<int, std::size_t>> points;
};

/// Finds the faces on the surface and on the coordinate planes of a body. The body consists of the grids `pieces`. If
/// two elements share a face on a plane, the result contains it once, with the points of the first element. The result
/// is empty if a grid does not consist of complete blocks of hexahedra (block_cells.h), or does not have the field
/// reference_coordinates.
std::vector<PictureFace> faces_of(const std::vector<UnstructuredGrid>& pieces);

/// A table with the columns of shapes.csv and the additional column `von_mises`. The result is the text of a CSV file.
/// The table contains the faces at up to eight of the times of pictures, including the first and the last time. It
/// contains fewer times if it would otherwise have more than 60000 rows. If the motion of the body is affine
/// (`is_affine`), the table contains one point at the times of all pictures. The text is empty if there are no
/// pictures, or if the list or a picture cannot be read. It is also empty if a picture does not have the fields
/// reference_coordinates and von_mises. A picture without all points of the faces of the first picture also makes the
/// text empty. Without `is_affine`, it is empty as well if the faces of the first picture have 0 or more than 30000
/// points.
std::string table_of_frames(const std::filesystem::path& pvd, bool is_affine);

}  // namespace pseudorigid::io
