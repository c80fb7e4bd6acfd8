#pragma once
/// The unit ball, or a sector of it cut out by coordinate planes, on curved hexahedra; or a whole body of another shape
/// made of hexahedra with trilinear maps, X(ξ) = Σ N_i(ξ) V_i.
///
/// One octant has 4 coarse cells: a block at the centre and three cells between its faces and the sphere. A coarse cell
/// with vertices V_i (trilinear shape functions N_i) is mapped by the transfinite interpolation
///
///   X(ξ) = Σ_{i inside} N_i(ξ) V_i + s(ξ) Y/|Y|,   s = Σ_{i on sphere} N_i(ξ),
///   Y_d = tan(π/4 y_d),   y = Σ_{i on sphere} N_i(ξ) V_i/|V_i|_∞ / s     (equiangular coordinates of the sphere)
///
/// which is exact on the sphere and on the planes (coordinates that are zero stay exactly zero). Other sectors are
/// reflections of the octant, so that all of them are the same discretisation.
///
/// A grading makes cells at the two poles ±e_p of an axis smaller by a factor g. Before the transfinite map, the local
/// coordinates of a coarse cell that run outwards, or along the surface from a plane through the poles, become
///
///   ξ ← (exp(βξ) − 1)/(exp β − 1),   β/(exp β − 1) = g,   the small end ξ = 0 at the sphere or at that plane,
///
/// the same on the faces of neighbours.
///
/// With several ranks the cells are distributed over them (p4est); every rank then holds its own and their neighbours.

#include <deal.II/grid/tria.h>

#include <array>
#include <memory>
#include <vector>

namespace pseudorigid::continuum {

/// Which coordinate planes cut the ball: reflect[i] is true if x_i = 0 is a symmetry plane of the computed sector.
struct Sector {
  std::array<bool, 3> reflect{false, false, false};
  int n_images() const { return (reflect[0] ? 2 : 1) * (reflect[1] ? 2 : 1) * (reflect[2] ? 2 : 1); }
};

/// A whole body by its hexahedra: the vertices of a cell have the first local direction fastest.
struct CoarseMesh {
  std::vector<dealii::Point<3>> vertices;
  std::vector<std::array<unsigned int, 8>> cells;
};

struct Grading {
  double size = 1;  ///< g
  int axis = 2;     ///< p
};

class BallMesh {
 public:
  /// The sector of the unit ball, refined `n_refinements` times, over the ranks of a communicator.
  BallMesh(const Sector& sector, int n_refinements, MPI_Comm communicator = MPI_COMM_SELF, const Grading& grading = {});
  /// The body of these cells, with the same checks: right-handed, conforming, in one piece, its centre of mass at the
  /// origin.
  BallMesh(const CoarseMesh& body, int n_refinements, MPI_Comm communicator = MPI_COMM_SELF);

  const dealii::Triangulation<3>& triangulation() const { return *triangulation_; }
  MPI_Comm communicator() const { return triangulation_->get_communicator(); }
  const Sector& sector() const { return sector_; }
  /// Boundary id of the free surface; the faces on the symmetry plane x_i = 0 have the id i.
  static constexpr dealii::types::boundary_id surface_id = 3;
  /// Number of an active cell among all, from its place in the hierarchy: the same on any number of ranks.
  std::size_t global_number(const dealii::Triangulation<3>::cell_iterator& cell) const;

  /// Position of the point ξ ∈ [0,1]³ of an active cell.
  dealii::Point<3> position(const dealii::Triangulation<3>::cell_iterator& cell, const dealii::Point<3>& xi) const;

 private:
  BallMesh(const Sector& sector, const CoarseMesh& coarse, bool on_sphere, int n_refinements, MPI_Comm communicator);

  Sector sector_;
  bool on_sphere_;     ///< vertices at the distance 1 are on the sphere
  double growth_ = 0;  ///< β
  std::unique_ptr<dealii::Triangulation<3>> triangulation_;
  std::vector<std::array<dealii::Point<3>, 8>> coarse_vertices_;
  /// [coarse cell][local direction]: the end with small cells, 0 or 1, or −1 if the direction is not graded.
  std::vector<std::array<int, 3>> small_ends_;
};

}  // namespace pseudorigid::continuum
