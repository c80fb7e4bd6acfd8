#pragma once
/// Positions of material surfaces for pictures: the surface of the undeformed body and its coordinate planes. Each
/// patch is a lattice of (m + 1)² points X = S ξ with m = 6:
///
///   surface, three patches per octant: ξ = p/|p|,  p = (1, tan πs/4, tan πt/4) and its cyclic permutations
///   plane, an inner and an outer patch per quarter: ξ = r (cos πs/2, sin πs/2),  r = t/2 and (1 + t)/2
///
/// with s, t = 0, 1/m, …, 1 and the matrix S of the semi-axes. In a coordinate plane, ξ has two components. Only the
/// patches in the computed sector are used, and the rest of the body follows by reflection. All positions are in
/// internal units.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "mechanics/core/shape_columns.h"
#include "polynomial/polynomial_space.h"

namespace pseudorigid::polynomial {

class MaterialFaces {
 public:
  explicit MaterialFaces(const PolynomialSpace& space);

  static constexpr auto columns = mechanics::shape_columns;
  /// Index of the first column that is a length. All later columns are also lengths.
  static constexpr std::size_t first_length = mechanics::first_length_of_shapes;

  /// One row with the entries of mechanics::shape_columns for each point of each patch. q has the coefficients of the
  /// position.
  std::vector<std::vector<double>> rows(const Eigen::VectorXd& q) const;

 private:
  /// A point of a patch. `face` is the number of the patch, from 1, and `plane` is the argument of add_patch.
  /// `functions` has the values of the basis functions at the reference position X.
  struct Point {
    int face, plane;
    Eigen::Vector3d X;
    std::vector<Jet> functions;
  };
  /// Adds the patches in the octant in which the coordinates have the signs `signs`, each 1 or −1.
  void add_octant(const Eigen::Vector3d& signs);
  /// Adds a patch in the octant with these signs. `plane` is k = 1, 2 or 3 for the plane ξ_k = 0, and 0 for the
  /// surface. at(s, t) returns the point ξ in the octant of positive coordinates.
  template <class Place>
  void add_patch(int plane, const Eigen::Vector3d& signs, const Place& at);

  const PolynomialSpace& space_;
  int n_faces_ = 0;
  std::vector<Point> points_;
};

}  // namespace pseudorigid::polynomial
