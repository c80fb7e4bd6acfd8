#pragma once
/// The unit ball, or a sector of the ball cut by coordinate planes, on curved hexahedra. The mesh can also be a whole
/// body of another shape made of hexahedra with the trilinear maps X(ξ) = Σ N_i(ξ) V_i. V_i are the vertices of a
/// hexahedron, and N_i are its trilinear shape functions.
///
/// An octant has 4 coarse cells: a block at the centre and three cells between the faces of this block and the sphere.
/// Their vertices are either on the sphere or inside the ball. The transfinite interpolation maps a coarse cell to
///
///   X(ξ) = Σ_{i inside} N_i(ξ) V_i + s(ξ) Y/|Y|,   s = Σ_{i on sphere} N_i(ξ),
///   Y_d = tan(π/4 y_d),   y = Σ_{i on sphere} N_i(ξ) V_i/|V_i|_∞ / s     (equiangular coordinates of the sphere)
///
/// If s = 0, the second term is absent. On a face whose vertices are on the sphere, s = 1 and |X| = 1, so the face is
/// exactly spherical. If all vertices of a face have x_d = 0, X_d is exactly 0 on the face. Sectors other than the
/// octant consist of reflections of the octant, so that all sectors have the same discretisation.
///
/// A grading reduces the size of cells at the two poles ±e_p of an axis by a factor g < 1. The grading changes local
/// coordinates ξ of the coarse cells before the transfinite map. These are the coordinates in the direction outwards to
/// the sphere, and those in the direction away from a plane through the poles:
///
///   ξ ← (exp(βξ) − 1)/(exp β − 1),   β/(exp β − 1) = g.
///
/// In this formula ξ is 0 at the end with small cells, which is on the sphere or on this plane. Neighbouring cells have
/// the same coordinates on their common face. Only the ball and its sectors can have a grading.
///
/// With several ranks, p4est distributes the cells over the ranks. Every rank then stores the coarse mesh, its own
/// cells and the neighbours of its own cells.

#include <deal.II/grid/tria.h>

#include <array>
#include <memory>
#include <vector>

namespace pseudorigid::continuum {

/// The symmetry planes that bound the computed sector of the ball. reflect[i] is true if x_i = 0 is such a plane. The
/// images of the sector, including the sector itself, make up the ball.
struct Sector {
  std::array<bool, 3> reflect{false, false, false};
  int n_images() const { return (reflect[0] ? 2 : 1) * (reflect[1] ? 2 : 1) * (reflect[2] ? 2 : 1); }
};

/// The hexahedra of a whole body. A cell is a list of the indices of its 8 vertices, with the first local direction as
/// the fastest index.
struct CoarseMesh {
  std::vector<dealii::Point<3>> vertices;
  std::vector<std::array<unsigned int, 8>> cells;
};

/// Factor and axis of the grading in the opening comment of this file, with 0 < size ≤ 1.
struct Grading {
  double size = 1;  ///< factor g; 1 means no grading
  int axis = 2;     ///< axis p of the two poles: 0, 1 or 2
};

class BallMesh {
 public:
  /// The sector of the unit ball. Every coarse cell is refined uniformly `n_refinements` times, into 8^n_refinements
  /// cells. The ranks of the communicator share the cells.
  BallMesh(const Sector& sector, int n_refinements, MPI_Comm communicator = MPI_COMM_SELF, const Grading& grading = {});
  /// A body of another shape with the coarse cells `body`, refined and distributed in the same way. The caller must
  /// have checked the cells (io/hexahedral_mesh.h) and moved the centre of mass to the origin.
  BallMesh(const CoarseMesh& body, int n_refinements, MPI_Comm communicator = MPI_COMM_SELF);

  const dealii::Triangulation<3>& triangulation() const { return *triangulation_; }
  MPI_Comm communicator() const { return triangulation_->get_communicator(); }
  const Sector& sector() const { return sector_; }
  /// Boundary id of the free surface. The faces on the symmetry plane x_i = 0 have the id i.
  static constexpr dealii::types::boundary_id surface_id = 3;
  /// Number of an active cell among the active cells of all ranks, from 0. The number depends only on the place of the
  /// cell in the hierarchy, and not on the distribution over the ranks.
  std::size_t global_number(const dealii::Triangulation<3>::cell_iterator& cell) const;

  /// Reference position X of the point ξ ∈ [0,1]³ of an active cell, with the grading.
  dealii::Point<3> position(const dealii::Triangulation<3>::cell_iterator& cell, const dealii::Point<3>& xi) const;

 private:
  BallMesh(const Sector& sector, const CoarseMesh& coarse, bool on_sphere, int n_refinements, MPI_Comm communicator);

  Sector sector_;
  bool on_sphere_;     ///< true for the ball and its sectors; false for a body of another shape
  double growth_ = 0;  ///< exponent β of the grading; 0 without grading
  std::unique_ptr<dealii::Triangulation<3>> triangulation_;
  /// Vertices of the coarse cells: [coarse cell][vertex], in the order of deal.II with the first local direction
  /// fastest.
  std::vector<std::array<dealii::Point<3>, 8>> coarse_vertices_;
  /// The end with small cells in each direction, 0 or 1, or −1 if the direction is not graded: [coarse cell][local
  /// direction]. The list is empty without grading.
  std::vector<std::array<int, 3>> small_ends_;
};

}  // namespace pseudorigid::continuum
