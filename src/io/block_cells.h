#pragma once
/// Conversion between blocks of points of a body (mechanics::PointBlocks) and cells of VTK.

#include <optional>

#include "io/vtu.h"
#include "mechanics/core/body_fields.h"
#include "scene/scene.h"

namespace pseudorigid::io {

/// Sets the type, the number of nodes and the connectivity of the cells of the grid. The grid must have the points to
/// which the blocks refer. With Cells::linear, a block is divided into degree³ hexahedra of 8 points. With
/// Cells::lagrange, a block is one Lagrange hexahedron of the same degree. Pictures then show the fields in a block as
/// polynomials. VTK interpolates as if the points were equidistant in the block.
void set_cells(UnstructuredGrid& grid, const mechanics::PointBlocks& blocks, scene::Cells cells);

/// The blocks from which `set_cells` made the cells of the grid. The result is empty if the cells are not hexahedra or
/// do not form complete blocks. A grid of linear cells does not store the degree p of the blocks. The function then
/// assumes that p is the length of the first row: successive cells of a row share a face. This length is too large if
/// the row consists of several blocks of degree 1. If the number of all cells is not a multiple of p³, the function
/// uses p = 1.
std::optional<mechanics::PointBlocks> blocks_of(const UnstructuredGrid& grid);

}  // namespace pseudorigid::io
