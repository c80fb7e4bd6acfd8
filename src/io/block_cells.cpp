#include "io/block_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pseudorigid::io {
namespace {

/// VTK's index of the point (i, j, k) of a Lagrange hexahedron of degree p. The order is corners, edges, faces,
/// interior. In files of version 1.0, the edges along k follow the order of the corners 0, 1, 3, 2 of the lower face.
/// VTK exchanges the last two of these edges when it reads such a file.
std::size_t place_in_hexahedron(std::size_t i, std::size_t j, std::size_t k, std::size_t p) {
  const std::size_t on_edge = p - 1, on_face = on_edge * on_edge;
  const auto is_end = [p](std::size_t index) { return index == 0 || index == p; };
  const bool i_ends = is_end(i), j_ends = is_end(j), k_ends = is_end(k);
  const std::size_t edges = 8, faces = edges + 12 * on_edge, inside = faces + 6 * on_face;
  if (i_ends && j_ends && k_ends) return (i ? (j ? 2 : 1) : (j ? 3 : 0)) + (k ? 4 : 0);
  if (j_ends && k_ends) return edges + (k ? 4 : 0) * on_edge + (j ? 2 : 0) * on_edge + i - 1;
  if (i_ends && k_ends) return edges + (k ? 4 : 0) * on_edge + (i ? 1 : 3) * on_edge + j - 1;
  if (i_ends && j_ends) return edges + (8 + (i ? (j ? 3 : 1) : (j ? 2 : 0))) * on_edge + k - 1;
  if (i_ends) return faces + (i ? 1 : 0) * on_face + (k - 1) * on_edge + j - 1;
  if (j_ends) return faces + (j ? 3 : 2) * on_face + (k - 1) * on_edge + i - 1;
  if (k_ends) return faces + (k ? 5 : 4) * on_face + (j - 1) * on_edge + i - 1;
  return inside + (k - 1) * on_face + (j - 1) * on_edge + i - 1;
}

/// The indices in a block of degree p of the points of its Lagrange cell, in VTK's order.
std::vector<std::size_t> lagrange_cell(std::size_t p) {
  std::vector<std::size_t> points((p + 1) * (p + 1) * (p + 1));
  for (std::size_t k = 0; k <= p; ++k)
    for (std::size_t j = 0; j <= p; ++j)
      for (std::size_t i = 0; i <= p; ++i) points[place_in_hexahedron(i, j, k, p)] = (k * (p + 1) + j) * (p + 1) + i;
  return points;
}

/// The indices in a block of degree p of the eight points of each of its p³ linear cells, cell by cell. A cell lists
/// the points of its lower face counter-clockwise, and then those of its upper face, as VTK requires.
std::vector<std::size_t> linear_cells(std::size_t p) {
  const std::size_t n = p + 1;
  const std::array<std::size_t, 8> corners{0, 1, n + 1, n, n * n, n * n + 1, n * n + n + 1, n * n + n};
  std::vector<std::size_t> points;
  for (std::size_t k = 0; k < p; ++k)
    for (std::size_t j = 0; j < p; ++j)
      for (std::size_t i = 0; i < p; ++i)
        for (const std::size_t corner : corners) points.push_back((k * n + j) * n + i + corner);
  return points;
}

/// The degree p of the blocks from which linear_cells made the cells of the grid. A block has p cells in a row, and
/// successive cells of a row share a face. Therefore p is the number of cells in the row at the beginning of the list.
/// The function cannot distinguish a row of a block of degree p from p adjacent blocks of degree 1. If the number of
/// all cells is not a multiple of p³, the result is 1, and each cell is a block.
std::size_t cells_in_a_row(const UnstructuredGrid& grid) {
  const auto share_a_face = [&](std::size_t cell) {
    const std::int64_t *here = &grid.connectivity[8 * cell], *next = here + 8;
    return here[1] == next[0] && here[2] == next[3] && here[5] == next[4] && here[6] == next[7];
  };
  std::size_t p = 1;
  while (p < grid.n_cells() && share_a_face(p - 1)) ++p;
  return grid.n_cells() % (p * p * p) == 0 ? p : 1;
}

/// The number, in the grid, of the point `place` = (i, j, k) of a block that linear_cells has divided. `cells` has the
/// eight point numbers of each of the p³ cells of the block. The point is the first corner of the cell (i, j, k). If an
/// index equals p, this cell does not exist, and the point is another corner of the last cell in this direction.
std::int64_t point_of_linear_block(const std::int64_t* cells, std::size_t p, std::array<std::size_t, 3> place) {
  constexpr std::array<std::size_t, 8> corner{0, 1, 3, 2, 4, 5, 7, 6};  // VTK's number of the corner i + 2j + 4k
  std::size_t cell = 0, which = 0;
  for (std::size_t d = 3; d-- > 0;) {
    const std::size_t at = std::min(place[d], p - 1);
    cell = cell * p + at;
    which = 2 * which + (place[d] - at);
  }
  return cells[8 * cell + corner[which]];
}

}  // namespace

std::optional<mechanics::PointBlocks> blocks_of(const UnstructuredGrid& grid) {
  const bool is_lagrange = grid.cell_type == CellType::lagrange_hexahedron;
  if (!is_lagrange && (grid.cell_type != CellType::hexahedron || grid.nodes_per_cell != 8)) return {};
  const std::size_t p =
      is_lagrange ? static_cast<std::size_t>(std::lround(std::cbrt(grid.nodes_per_cell))) - 1 : cells_in_a_row(grid);
  const std::size_t n = p + 1, n_nodes = is_lagrange ? n * n * n : 8 * p * p * p;
  if (p < 1 || grid.connectivity.size() % n_nodes != 0) return {};
  if (is_lagrange && static_cast<std::size_t>(grid.nodes_per_cell) != n_nodes) return {};
  const std::vector<std::size_t> place_of = is_lagrange ? lagrange_cell(p) : std::vector<std::size_t>();
  mechanics::PointBlocks blocks{.degree = static_cast<int>(p), .points = {}};
  blocks.points.resize(grid.connectivity.size() / n_nodes * n * n * n);
  for (std::size_t block = 0; block < blocks.n_blocks(); ++block) {
    const std::int64_t* cells = &grid.connectivity[block * n_nodes];
    std::int64_t* points = &blocks.points[block * n * n * n];
    for (std::size_t c = 0; c < n * n * n; ++c)
      if (is_lagrange)
        points[place_of[c]] = cells[c];
      else
        points[c] = point_of_linear_block(cells, p, {c % n, c / n % n, c / (n * n)});
  }
  return blocks;
}

void set_cells(UnstructuredGrid& grid, const mechanics::PointBlocks& blocks, scene::Cells cells) {
  const auto p = static_cast<std::size_t>(blocks.degree);
  const bool is_lagrange = cells == scene::Cells::lagrange;
  grid.cell_type = is_lagrange ? CellType::lagrange_hexahedron : CellType::hexahedron;
  grid.nodes_per_cell = is_lagrange ? static_cast<int>(blocks.points_per_block()) : 8;
  const std::vector<std::size_t> in_block = is_lagrange ? lagrange_cell(p) : linear_cells(p);
  grid.connectivity.clear();
  grid.connectivity.reserve(blocks.n_blocks() * in_block.size());
  for (std::size_t block = 0; block < blocks.n_blocks(); ++block)
    for (const std::size_t place : in_block)
      grid.connectivity.push_back(blocks.points[block * blocks.points_per_block() + place]);
}

}  // namespace pseudorigid::io
