#pragma once
/// Faces of a body for a report, from the pictures of a run (`<model>.pvd`). The faces are on the surface and on the
/// coordinate planes of the undeformed body. A face is a lattice of (p + 1)² material points of an element of degree p.

#include <filesystem>
#include <string>
#include <vector>

#include "io/vtu.h"
#include "mechanics/core/shape_columns.h"

namespace pseudorigid::io {

struct PictureFace {
  int plane;                                        ///< 0: surface; 1, 2 or 3: coordinate plane with this normal
  std::vector<std::pair<int, std::size_t>> points;  ///< index in `pieces` and number of each point, row by row
};

/// Finds the faces of a body. `pieces` are grids that together make the body. If two elements share a face on a plane,
/// the face has the values of the first element. The result is empty if a grid does not consist of hexahedra or lacks
/// the field reference_coordinates.
std::vector<PictureFace> faces_of(const std::vector<UnstructuredGrid>& pieces);

/// A table with the columns of shapes.csv and the additional last column `von_mises`, at up to eight times of pictures.
/// A body with the motion x = QX, Q a matrix, is one point at all times of pictures. The table is empty if the pictures
/// do not show reference coordinates and stress.
std::string table_of_frames(const std::filesystem::path& pvd, bool is_affine);

}  // namespace pseudorigid::io
