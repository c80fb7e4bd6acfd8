// Writes one VTU file of every kind into a folder, for tests/support/check_vtu.py to read.
// Sample run: write_vtu_samples /tmp/samples

#include <cmath>
#include <filesystem>
#include <string>

#include "io/ball_blocks.h"
#include "io/block_cells.h"
#include "io/body_picture.h"
#include "io/vtu.h"

using namespace pseudorigid::io;
namespace scene = pseudorigid::scene;
namespace mechanics = pseudorigid::mechanics;

namespace {

/// Two hexahedra side by side; the field place_in_cell says where in its cell a node belongs.
UnstructuredGrid hexahedra() {
  UnstructuredGrid grid;
  std::vector<double> reference, tensor, scalar;
  for (int cell = 0; cell < 2; ++cell) {
    const auto first = static_cast<std::int64_t>(grid.n_points());
    for (const int node : {0, 1, 3, 2, 4, 5, 7, 6}) grid.connectivity.push_back(first + node);
    for (int node = 0; node < 8; ++node) {
      const double x = node & 1, y = node >> 1 & 1, z = node >> 2;
      reference.insert(reference.end(), {x, y, z});
      const double bulge = 0.1 * std::sin(2 * (x + cell)) * y;
      grid.points.insert(grid.points.end(), {x + cell, y + bulge, z - bulge});
      scalar.push_back(1 + bulge);
      for (int i = 0; i < 9; ++i) tensor.push_back(i + x * y * z);
    }
  }
  grid.fields = {{"place_in_cell", 3, reference}, {"jacobian", 1, scalar}, {"stress", 9, tensor}};
  return grid;
}

UnstructuredGrid triangles() {
  return {.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.5},
          .cell_type = CellType::triangle,
          .nodes_per_cell = 3,
          .connectivity = {0, 1, 2, 1, 3, 2},
          .fields = {}};
}

/// A cube as one Lagrange hexahedron of this degree, with the place of each point in it.
UnstructuredGrid lagrange_hexahedron(int degree) {
  mechanics::PointBlocks block{.degree = degree, .points = {}};
  UnstructuredGrid grid;
  std::vector<double> reference;
  for (int k = 0; k <= degree; ++k)
    for (int j = 0; j <= degree; ++j)
      for (int i = 0; i <= degree; ++i) {
        const double x = i / double(degree), y = j / double(degree), z = k / double(degree);
        block.points.push_back(static_cast<std::int64_t>(block.points.size()));
        reference.insert(reference.end(), {x, y, z});
        grid.points.insert(grid.points.end(), {x + 0.1 * y * z, y, z + 0.1 * x * (1 - x)});
      }
  set_cells(grid, block, scene::Cells::lagrange);
  grid.fields = {{"place_in_cell", 3, reference}};
  return grid;
}

/// x = QX under one stress, with values of the whole body.
UnstructuredGrid ellipsoid(scene::Cells cells) {
  const BallBlocks ball = ball_blocks(4, 2);
  Eigen::Matrix3d Q, stress;
  Q << 1.6, 0.3, 0, 0, 0.9, 0, 0, 0, 0.7;
  stress << 2, 0.1, 0, 0.1, -1, 0, 0, 0, -1;
  mechanics::BodyFields fields;
  for (const Eigen::Vector3d& X : ball.points) fields.add(X, Q * X, X, Q, stress, 0.5);
  fields.moment = Q;
  return body_picture(ball.blocks, fields, 0.25, {}, {}, cells);
}

/// More than one compressed block an array, and numbers without pattern.
UnstructuredGrid large() {
  UnstructuredGrid grid{.cell_type = CellType::triangle, .nodes_per_cell = 3};
  for (std::int64_t i = 0; i < 40'000; ++i) {
    const double x = std::fmod(static_cast<double>(i) * 0.6180339887498949, 1);
    grid.points.insert(grid.points.end(), {x, x * x, std::sin(1000 * x)});
    grid.connectivity.insert(grid.connectivity.end(), {i, (i + 1) % 40'000, (i + 7) % 40'000});
  }
  grid.fields = {{"copy", 3, grid.points}};
  return grid;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  write_vtu(folder / "ellipsoid.vtu", ellipsoid(scene::Cells::linear));
  write_vtu(folder / "curved_ellipsoid.vtu", ellipsoid(scene::Cells::lagrange));
  write_vtu(folder / "triangles.vtu", triangles());
  write_vtu(folder / "hexahedra.vtu", hexahedra());
  write_vtu(folder / "large.vtu", large());
  for (const int degree : {1, 2, 3, 4, 5}) {
    const std::string name = "lagrange_" + std::to_string(degree) + ".vtu";
    write_vtu(folder / name, lagrange_hexahedron(degree));
  }
}
