#pragma once
/// Cells for the blocks of points of a body.

#include <optional>

#include "io/vtu.h"
#include "mechanics/core/body_fields.h"
#include "scene/scene.h"

namespace pseudorigid::io {

/// linear: degree³ hexahedra a block. lagrange: one hexahedron of the block's degree, whose points VTK takes for
/// equidistant; the fields of a block are then shown as polynomials.
void set_cells(UnstructuredGrid& grid, const mechanics::PointBlocks& blocks, scene::Cells cells);

/// The blocks whose cells `set_cells` has made. Empty if the cells are not hexahedra.
std::optional<mechanics::PointBlocks> blocks_of(const UnstructuredGrid& grid);

}  // namespace pseudorigid::io
