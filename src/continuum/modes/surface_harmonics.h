#pragma once
/// Which kind of mode of the sphere a small motion is, from its surface. With e = X/|X|, real spherical harmonics Y_nm,
/// ∇ on the unit sphere and N = n(n+1), a field on the sphere is the sum of the orthonormal fields
///
///   Y e,   ∇Y/√N   (spheroidal),        e×∇Y/√N   (toroidal),
///
/// and a mode of degree n has only those of its kind and degree. (No mode is zero on the free surface: displacement and
/// traction would both vanish there.) Only harmonics of the field's own parity are looked at, so an octant is enough.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "continuum/mesh/ball_space.h"
#include "continuum/mesh/surface_faces.h"
#include "continuum/modes/parity.h"

namespace pseudorigid::continuum {

/// The numbers are those of modes.csv.
enum class ModeKind { spheroidal = 1, toroidal = 2 };

struct ModeClass {
  ModeKind kind = ModeKind::spheroidal;
  int degree = 0;
  double share = 0;  ///< of the squared surface displacement
};

/// The highest degree with a point of the mesh for every half wave on a great circle; at most 64.
int largest_resolved_degree(const BallSpace& space);

/// A Gauss rule with more points than the elements have nodes, for products with harmonics.
std::vector<FacePoint> harmonic_quadrature(const BallSpace& space, const CellFace& face);

class SurfaceHarmonics {
 public:
  /// For fields on an octant with this parity; degrees up to `max_degree`. The space must outlive this object.
  SurfaceHarmonics(const BallSpace& space, const Parity& parity, int max_degree);

  int max_degree() const { return max_degree_; }

  /// The kind and degree with the largest share.
  ModeClass classify(const Vector& u) const;

  /// The numbers of the fields Y_nm e of degree n; the field ∇Y_nm/√N of the same harmonic has the next number.
  std::vector<std::size_t> radial_fields(int n) const;
  /// ∮u·field dS over the whole sphere.
  double integral(std::size_t field, const Vector& u) const;
  /// The force f·w = ∮w·field dS on the octant.
  Vector force(std::size_t field) const;

 private:
  struct Point {
    FacePoint on_face;
    Eigen::Vector3d e;  ///< on the unit sphere
    double area;        ///< of the whole sphere's
  };
  struct Row {
    ModeKind kind;
    int degree;
  };
  void find_points();
  void add_harmonic(int n, int m, bool sine, const Parity& parity);
  void add_row(ModeKind kind, int degree, const Eigen::Matrix3Xd& field);

  const BallSpace& space_;
  int max_degree_;
  std::vector<Point> points_;
  std::vector<Row> rows_;
  std::vector<Eigen::Matrix3Xd> fields_;  ///< a row's field at the points, times their weights
};

}  // namespace pseudorigid::continuum
