#pragma once
/// Faces of a body for a report, computed from the pictures of a run (`<model>.pvd`). The faces are on the surface and
/// on the coordinate planes of the undeformed body. A face consists of (p + 1)² material points of a block of degree p
/// (mechanics::PointBlocks), which may be a finite element.

#include <filesystem>
#include <string>
#include <vector>

#include "io/vtu.h"
#include "mechanics/core/shape_columns.h"

namespace pseudorigid::io {

/// A face of a block on the surface or on a coordinate plane of the undeformed body.
struct PictureFace {
  int plane;  ///< 0: surface; 1, 2, 3: coordinate plane with normal x, y, z
  /// The points row by row, with p + 1 points in a row. A point is given by the index of its grid in the argument of
  /// faces_of, and by its index in this grid.
  std::vector<std::pair<int, std::size_t>> points;
};

/// Finds the faces on the surface and on the coordinate planes of a body. The body consists of the grids `pieces`. If
/// two blocks share a face on a plane, the result contains this face once, with the points of the first block. The
/// result is empty if a grid does not consist of complete blocks of hexahedra (block_cells.h), or does not have the
/// field reference_coordinates.
std::vector<PictureFace> faces_of(const std::vector<UnstructuredGrid>& pieces);

/// Returns the text of a CSV file with the column time, the columns of shapes.csv (mechanics/core/shape_columns.h) and
/// the column von_mises, in the units of the user. `pvd` is the file with the list of the pictures (pvd.h). If
/// `is_affine` is false, the rows are the points of the faces at up to eight times of pictures, including the first and
/// the last time. There are fewer times if the table would otherwise have more than 60000 rows. If `is_affine` is true,
/// the motion of the body is affine, and each picture gives one row, for one point. The text is empty in the following
/// cases:
///   - There are no pictures, or the list or a picture cannot be read.
///   - A picture lacks the field reference_coordinates or von_mises.
///   - `is_affine` is false, and a picture lacks a point of the faces of the first picture.
///   - `is_affine` is false, and the faces of the first picture have 0 or more than 30000 points.
std::string table_of_frames(const std::filesystem::path& pvd, bool is_affine);

}  // namespace pseudorigid::io
