#pragma once
/// Classification of small motions of the ball. The displacement of the surface determines the kind and the degree of
/// the mode of a sphere that is most similar to the motion. Let e = X/|X|, and let ∇ be the gradient on the unit
/// sphere. With real spherical harmonics Y_nm and N = n(n+1), a field on the sphere is a sum of the orthonormal fields
///
///   Y e,   ∇Y/√N   (spheroidal),        e×∇Y/√N   (toroidal).
///
/// On the surface, a mode of degree n contains only the fields of its kind and degree. Its surface displacement is not
/// zero, because a mode without displacement and traction on the surface would vanish everywhere. The computation uses
/// only harmonics with the parity of the motion. Therefore an octant is sufficient.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "continuum/mesh/ball_space.h"
#include "continuum/mesh/surface_faces.h"
#include "continuum/modes/parity.h"

namespace pseudorigid::continuum {

/// Kind of a mode. The output file modes.csv contains the numbers of the kinds.
enum class ModeKind { spheroidal = 1, toroidal = 2 };

struct ModeClass {
  ModeKind kind = ModeKind::spheroidal;
  int degree = 0;
  double share = 0;  ///< share of this class in the squared surface displacement
};

/// The highest degree n for which a great circle of the mesh has at least 2n nodes, one for each half wave of a
/// harmonic. The result is at most 64.
int largest_resolved_degree(const BallSpace& space);

/// A Gauss rule with more points than the elements have nodes, for products of fields with harmonics.
std::vector<FacePoint> harmonic_quadrature(const BallSpace& space, const CellFace& face);

class SurfaceHarmonics {
 public:
  /// The fields have the parity `parity` and at most the degree `max_degree`. The space must outlive this object.
  SurfaceHarmonics(const BallSpace& space, const Parity& parity, int max_degree);

  int max_degree() const { return max_degree_; }

  /// Returns the kind and the degree with the largest share in the squared surface displacement of u, and this share.
  /// The share is 0 if u is 0 on the surface.
  ModeClass classify(const Vector& u) const;

  /// The indices of the fields Y_nm e of degree n. For n > 0, the field ∇Y_nm/√N of the same harmonic has the next
  /// index.
  std::vector<std::size_t> radial_fields(int n) const;
  /// ∮u·field dS over the whole sphere, for the field with this index.
  double integral(std::size_t field, const Vector& u) const;
  /// The force f on the octant with f·w = ∮w·field dS for every w, for the field with this index. The integral is over
  /// the octant.
  Vector force(std::size_t field) const;

 private:
  struct Point {
    FacePoint on_face;
    Eigen::Vector3d e;  ///< point of the unit sphere
    double area;        ///< quadrature weight for integrals over the whole sphere
  };
  /// Kind and degree of one of the orthonormal fields.
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
  /// Field of each row at the points, multiplied by the `area` of the point: (component, point).
  std::vector<Eigen::Matrix3Xd> fields_;
};

}  // namespace pseudorigid::continuum
