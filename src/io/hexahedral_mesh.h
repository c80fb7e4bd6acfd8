#pragma once
/// A mesh of hexahedra. Each cell is the image of the cube [0,1]³ under a trilinear map,
///
///   X(ξ) = Σ_i N_i(ξ) V_i,   ξ ∈ [0,1]³,   i = i₁ + 2 i₂ + 4 i₃ with ξ = (i₁, i₂, i₃) at V_i,
///
/// with the vertices V_i and the trilinear shape functions N_i. The mesh is one body if it satisfies the following
/// conditions. det ∂X/∂ξ is positive at every point of every cell (right-handed cells). A chain of shared faces
/// connects any two cells. Every vertex belongs to a cell. At most two cells share a face. Neighbouring cells share
/// whole faces with the same vertices.

#include <array>
#include <vector>

namespace pseudorigid::io {

/// The vertices and cells of a mesh. A cell lists the indices of its vertices V₀ … V₇.
struct HexahedralMesh {
  using Point = std::array<double, 3>;
  std::vector<Point> vertices;
  std::vector<std::array<unsigned int, 8>> cells;
  std::vector<long> vertex_names, cell_names;  ///< numbers of the vertices and cells in the mesh file, for messages
};

/// Reverses the orientation of every cell if all cells are left-handed (det ∂X/∂ξ < 0) at their centres. Otherwise the
/// mesh is unchanged.
void turn_right_handed(HexahedralMesh& mesh);

/// Throws UserError if the mesh is not one body or does not have a cell. The message names the cells or vertices that
/// violate a condition. Some strongly distorted right-handed cells are also rejected, because the test uses a lower
/// bound of det ∂X/∂ξ. The conditions do not depend on the unit of length or on the position of the body.
void require_one_body(const HexahedralMesh& mesh);

/// The volume, the centre of mass for a constant density, and the largest distance of a vertex from this centre. The
/// unit of length is that of the mesh.
struct MeshSize {
  double volume;
  HexahedralMesh::Point center;
  double radius;
};
/// Computes the size of a mesh. The mesh must be one body (require_one_body).
MeshSize size_of(const HexahedralMesh& mesh);

}  // namespace pseudorigid::io
