#pragma once
/// A body made of hexahedra with trilinear maps of the cube,
///
///   X(ξ) = Σ_i N_i(ξ) V_i,   ξ ∈ [0,1]³,   i = i₁ + 2 i₂ + 4 i₃ with ξ = (i₁, i₂, i₃) at V_i,
///
/// and the conditions for one body: cells are right-handed everywhere, every vertex belongs to a cell, a face to two
/// cells or to the surface, neighbouring cells share their vertices, and all cells are connected.

#include <array>
#include <vector>

namespace pseudorigid::io {

struct HexahedralMesh {
  using Point = std::array<double, 3>;
  std::vector<Point> vertices;
  std::vector<std::array<unsigned int, 8>> cells;
  std::vector<long> vertex_names, cell_names;  ///< their numbers in the file, for messages
};

/// Numbers the vertices of every cell the other way round if all cells are left-handed.
void turn_right_handed(HexahedralMesh& mesh);

/// Throws UserError, one sentence that names the cells or vertices concerned. Neither the unit of length nor the place
/// of the body counts.
void require_one_body(const HexahedralMesh& mesh);

/// Volume, centre of mass for a constant density, and the largest distance of a vertex from it.
struct MeshSize {
  double volume;
  HexahedralMesh::Point center;
  double radius;
};
MeshSize size_of(const HexahedralMesh& mesh);

}  // namespace pseudorigid::io
