#pragma once
/// Positions of material surfaces for pictures: the faces of the finite elements on the free surface and on the
/// coordinate planes of the undeformed body. Each face has a lattice of points
///
///   x(ξ_a, ξ_b) = Σ_ij ℓ_i(ξ_a) ℓ_j(ξ_b) x_ij,   ξ_a = a/m,  a, b = 0 … m
///
/// with the nodal positions x_ij of the face, the Lagrange polynomials ℓ_i of the nodes and m intervals per direction.
/// The rows are in internal units, and only for the computed sector. Reflections give the rest of the body.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "continuum/mesh/ball_space.h"
#include "continuum/mesh/surface_faces.h"
#include "mechanics/core/shape_columns.h"

namespace pseudorigid::continuum {

class MaterialFaces {
 public:
  /// Finds the faces and chooses m by their number on all ranks. Collective.
  explicit MaterialFaces(const BallSpace& space);

  static constexpr auto columns = mechanics::shape_columns;
  static constexpr std::size_t first_length = mechanics::first_length_of_shapes;

  std::size_t n_points() const { return n_faces_ * (m_ + 1) * (m_ + 1); }  ///< number of lattice points on all ranks
  /// Returns one row with the entries `columns` for each lattice point of the faces of all ranks. `position` has the
  /// current positions of the nodes. The order of the rows does not depend on the number of ranks. The result is
  /// complete on rank 0 and empty on other ranks. Collective.
  std::vector<std::vector<double>> rows(const Vector& position) const;

 private:
  struct Face {
    CellFace place;
    int plane;        ///< 0: free surface; 1 … 3: coordinate plane
    std::size_t key;  ///< number that orders the faces of all ranks
  };
  static constexpr std::size_t n_columns = columns.size();
  void find_faces();
  void choose_lattice();
  Eigen::Matrix3Xd lattice(const Vector& x, const Face& face) const;
  std::vector<double> own_rows(const Vector& position) const;

  const BallSpace& space_;
  std::vector<Face> faces_;          ///< faces of this rank
  std::size_t n_faces_ = 0;          ///< number of faces on all ranks
  int m_ = 1;                        ///< m, the number of intervals of the lattice per direction
  std::vector<double> interpolate_;  ///< row-major [a][i]: ℓ_i(a/m)
};

}  // namespace pseudorigid::continuum
