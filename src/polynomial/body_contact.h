#pragma once
/// Contact of a polynomial body with rigid planes (loads/plane.h). The reference position is X = S ξ, with the diagonal
/// matrix S of the semi-axes and a point ξ of the unit ball. The contact is computed by quadrature on the unit sphere
/// of ξ. An octant of the sphere has n_points points in each direction. The weight w of a point is the area of its part
/// of the sphere. A plane n·x = z₀(t) has the unit normal n and the stiffness k. The position x has the coefficients
/// q_a of the basis functions φ_a. With sums over the points with d > 0, the energy V and its force are
///
///   V = Σ_planes Σ_points w k d²/2,   d = z₀ − n·x,   x = Σ q_a φ_a,   −∂V/∂q_a = Σ w k d n φ_a.
///
/// Damping and friction are sums over the same points. For a body of degree 1, the sums are replaced by the contact and
/// the friction of an ellipsoid (loads/ellipsoid_contact.h, loads/ellipsoid_friction.h), as in the pseudo-rigid model.
/// For higher degrees, the sums of affine motions converge to these results as n_points increases. The sums are omitted
/// if a lower bound of n·x shows that the body does not reach any plane. With the affine part c + A X of x, the bound
/// is
///
///   n·x ≥ n·c − |SAᵀn| − Σ_ia |n_i q_ia| max|φ_a|,   a over the functions of degree 2 and higher,
///
/// with the components n_i of n and q_ia of q_a. The maximum is over the quadrature points.

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "loads/ellipsoid_friction.h"
#include "polynomial/polynomial_space.h"

namespace pseudorigid::polynomial {

class BodyContact {
 public:
  /// The default of n_points. The 24² points of an octant are at most about 0.065 apart on the unit sphere.
  static constexpr int usual_points = 24;

  BodyContact(const loads::Planes& planes, std::shared_ptr<const PolynomialSpace> space, int n_points = usual_points);

  /// The contact of the whole body at the time t, for the observables.
  loads::Contact contact(double t, const Eigen::VectorXd& q) const;
  double energy(double t, const Eigen::VectorXd& q) const { return contact(t, q).energy; }
  /// f ← f − ∂V/∂q. Returns the power that moving planes give through this force.
  double add_force(double t, const Eigen::VectorXd& q, Eigen::VectorXd& f) const;
  /// f ← f − D²V(q)[u]
  void add_force_rate(double t, const Eigen::VectorXd& q, const Eigen::VectorXd& u, Eigen::VectorXd& f) const;
  /// Adds the damping force and the friction at the velocity v to f. Returns the power that they dissipate, and the
  /// power that moving planes give through the damping force.
  loads::ContactPower add_dissipation(double t, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                      Eigen::VectorXd& f) const;
  /// f ← f − C u. C is the linearisation `kind` of damping and friction at the velocity v (mechanics/core/damping.h).
  void add_damping(double t, const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& u,
                   mechanics::Linearization kind, Eigen::VectorXd& f) const;
  /// f ← f − ∂E/∂u with E = ½k∮|u|² dA for a displacement u. The integral is over the unit sphere, and k is
  /// Planes::stiffness_of_all(). This is the force of springs that pull every point of the surface back by its
  /// displacement.
  void add_holding_force(const Eigen::VectorXd& u, Eigen::VectorXd& f) const;

 private:
  /// A vector field at all points of the tables, with the entries [component][point].
  using Field = std::vector<double>;

  bool is_affine() const { return space_->degree() == 1; }
  /// False if the bound in the head of this file shows that the body does not reach the plane. With several planes,
  /// false if the body does not reach any of them.
  bool may_touch(const loads::Plane& plane, const Eigen::VectorXd& q) const;
  bool may_touch(const loads::Planes& planes, const Eigen::VectorXd& q) const;
  /// The positions x at all points of the tables.
  Field positions(const Eigen::VectorXd& q) const;
  /// `at` returns the vector of a field at the point with the index `place` in the tables. `add_at` adds `value` to
  /// this vector.
  Eigen::Vector3d at(const Field& field, std::size_t place) const;
  void add_at(Field& field, std::size_t place, const Eigen::Vector3d& value) const;
  /// The sums of contact (loads/contact.h) over the points of the computed sector, one for each plane. The images of
  /// the sector in the rest of the body are not included. x has the positions of the points.
  std::vector<loads::PlaneContact> of_points(const loads::Planes& planes, const Field& x) const;
  /// Calls visit(plane, place, w, d) for the points with d > 0. `place` is the index of the point in the tables.
  template <class Visit>
  void for_touching_points(const loads::Planes& planes, const Field& x, Visit&& visit) const;
  /// f ← f + damping force at the velocity u. Returns the dissipated power, and the power of moving planes.
  loads::ContactPower add_plane_damping(const loads::Planes& planes, const Eigen::VectorXd& q, const Eigen::VectorXd& u,
                                        Eigen::VectorXd& f) const;
  /// f ← f + friction at the velocity v. Returns the dissipated power.
  double add_friction(const loads::Planes& planes, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                      Eigen::VectorXd& f) const;
  /// The contact of the ellipsoid that the affine part of the position with the coefficients q describes.
  loads::EllipsoidContact affine_contact(const loads::Plane& plane, const Eigen::VectorXd& q) const;
  /// Adds a generalised force to f. `by_point` has a force at each point of the computed sector, and the function
  /// includes the images of these forces. The values of `by_point` are overwritten. `force` is an affine force on the
  /// whole body.
  void spread(Field& by_point, Eigen::VectorXd& f) const;
  void spread(const loads::AffineForce& force, Eigen::VectorXd& f) const;

  loads::Planes planes_;
  std::shared_ptr<const PolynomialSpace> space_;
  Eigen::Matrix3d S_;
  PointTables tables_;
  std::vector<std::size_t> places_;  ///< indices of the points in the tables, which also have padding
  std::vector<double> weights_;      ///< areas of the sphere that the points represent
  std::vector<double> largest_;  ///< max|φ_a| at the points for each coefficient; 0 for constant and linear functions
};

}  // namespace pseudorigid::polynomial
