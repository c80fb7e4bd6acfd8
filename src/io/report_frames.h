#pragma once
/// The faces of a body that a report draws, taken from the pictures of a run (`<model>.pvd`). They are on the surface
/// and on the coordinate planes of the undeformed body. A face is a lattice of (p + 1)² material points of an element
/// of degree p.

#include <filesystem>
#include <string>
#include <vector>

#include "io/vtu.h"
#include "mechanics/core/shape_columns.h"

namespace pseudorigid::io {

struct PictureFace {
  int plane;                                        ///< 0: the surface; 1, 2, 3: the coordinate plane with this normal
  std::vector<std::pair<int, std::size_t>> points;  ///< piece and number of each point, row by row
};

/// `pieces`: the grids that make one body, with the field reference_coordinates. If two elements share a
/// face on a plane, the face has the values of the first one. Empty if a grid does not have that field or does not
/// consist of hexahedra.
std::vector<PictureFace> faces_of(const std::vector<UnstructuredGrid>& pieces);

/// A table in the form of shapes.csv with the column `von_mises` behind the others, at no more than eight of the times
/// at which there are pictures. A body that moves as x = QX is one point, at all times. Empty if the run does not have
/// pictures that show reference coordinates and stress.
std::string table_of_frames(const std::filesystem::path& pvd, bool is_affine);

}  // namespace pseudorigid::io
