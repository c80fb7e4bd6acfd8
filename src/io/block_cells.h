#pragma once
/// Conversion between blocks of points of a body and cells of VTK.

#include <optional>

#include "io/vtu.h"
#include "mechanics/core/body_fields.h"
#include "scene/scene.h"

namespace pseudorigid::io {

/// Makes the cells of the blocks. `linear` divides a block into degree³ hexahedra. `lagrange` makes one hexahedron of
/// the degree of the block. Pictures then show the fields of a block as polynomials, and VTK treats its points as
/// equidistant.
void set_cells(UnstructuredGrid& grid, const mechanics::PointBlocks& blocks, scene::Cells cells);

/// The blocks from which `set_cells` made the cells. Empty if the cells are not hexahedra.
std::optional<mechanics::PointBlocks> blocks_of(const UnstructuredGrid& grid);

}  // namespace pseudorigid::io
