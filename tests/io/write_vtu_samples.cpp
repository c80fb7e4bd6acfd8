// Writes one VTU file of every kind into a folder, for tests/support/check_vtu.py to read.
// Sample run: write_vtu_samples /tmp/samples

#include <cmath>
#include <filesystem>

#include "io/ellipsoid_surface.h"
#include "io/vtu.h"

using namespace pseudorigid::io;

namespace {

/// Two hexahedra side by side; the field reference_coordinates says where in its cell a node belongs.
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
  grid.fields = {{"reference_coordinates", 3, reference}, {"jacobian", 1, scalar}, {"stress", 9, tensor}};
  return grid;
}

UnstructuredGrid triangles() {
  return {.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.5},
          .cell_type = CellType::triangle,
          .nodes_per_cell = 3,
          .connectivity = {0, 1, 2, 1, 3, 2},
          .fields = {}};
}

UnstructuredGrid ellipsoid() {
  HomogeneousState state;
  state.Q << 1.6, 0.3, 0, 0, 0.9, 0, 0, 0, 0.7;
  state.cauchy_stress << 2, 0.1, 0, 0.1, -1, 0, 0, 0, -1;
  return ellipsoid_surface(CubedSphere(12), state);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  write_vtu(folder / "ellipsoid.vtu", ellipsoid());
  write_vtu(folder / "triangles.vtu", triangles());
  write_vtu(folder / "hexahedra.vtu", hexahedra());
}
