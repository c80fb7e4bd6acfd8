#include "io/block_cells.h"

#include <array>
#include <cstddef>
#include <vector>

namespace pseudorigid::io {
namespace {

/// VTK's place of the point (i, j, k) among those of a Lagrange hexahedron of degree p: corners, edges, faces, inside.
/// Files of version 1.0 number the edges along k as 0, 1, 3, 2; VTK turns the last two round as it reads.
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

/// Of the cells of a block, the points by their places in it.
std::vector<std::size_t> lagrange_cell(std::size_t p) {
  std::vector<std::size_t> points((p + 1) * (p + 1) * (p + 1));
  for (std::size_t k = 0; k <= p; ++k)
    for (std::size_t j = 0; j <= p; ++j)
      for (std::size_t i = 0; i <= p; ++i) points[place_in_hexahedron(i, j, k, p)] = (k * (p + 1) + j) * (p + 1) + i;
  return points;
}

/// Likewise, the lower face counter-clockwise, then the upper one.
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

}  // namespace

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
