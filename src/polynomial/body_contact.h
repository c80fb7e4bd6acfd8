#pragma once
/// Contact of a polynomial body with rigid planes (loads/plane.h), by the sum over q² points of each octant of the
/// sphere ξ. Areas are those of this sphere:
///
///   V = Σ_planes Σ_points w k d²/2,   d = z₀ − n·x,   x = Σ q_a φ_a,   −∂V/∂q_a = Σ w k d n φ_a.
///
/// The body of degree 1 has the closed form of the pseudo-rigid body (loads/ellipsoid_contact.h). The sum of a higher
/// degree tends to it on affine motions as q rises. A plane that a bound for the body does not reach costs no sum:
///
///   n·x ≥ n·c − |SAᵀn| − Σ_a |n·q_a| max|φ_a|,   a over the functions of degree 2 and more.

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "loads/ellipsoid_contact.h"
#include "polynomial/polynomial_space.h"

namespace pseudorigid::polynomial {

class BodyContact {
 public:
  /// q, with which the 24² points of an octant are 0.065 r apart.
  static constexpr int usual_points = 24;

  BodyContact(const loads::Planes& planes, std::shared_ptr<const PolynomialSpace> space, int n_points = usual_points);

  loads::Contact contact(const Eigen::VectorXd& q) const;
  double energy(const Eigen::VectorXd& q) const { return contact(q).energy; }
  /// f ← f − ∂V/∂q
  void add_force(const Eigen::VectorXd& q, Eigen::VectorXd& f) const;
  /// f ← f − D²V(q)[u]
  void add_force_rate(const Eigen::VectorXd& q, const Eigen::VectorXd& u, Eigen::VectorXd& f) const;
  /// f ← f + the force of the damping; returns the power that it takes.
  double add_damping(const Eigen::VectorXd& q, const Eigen::VectorXd& v, Eigen::VectorXd& f) const;
  /// f ← f − ∂/∂u of ½k∮|u|², of a displacement u against which planes on all sides hold every point.
  void add_holding_force(const Eigen::VectorXd& u, Eigen::VectorXd& f) const;

 private:
  /// Values at all points: [component][point].
  using Field = std::vector<double>;

  bool is_affine() const { return space_->degree() == 1; }
  bool may_touch(const loads::Plane& plane, const Eigen::VectorXd& q) const;
  bool may_touch(const Eigen::VectorXd& q) const;
  Field positions(const Eigen::VectorXd& q) const;
  Eigen::Vector3d at(const Field& field, std::size_t place) const;
  void add_at(Field& field, std::size_t place, const Eigen::Vector3d& value) const;
  /// The contacts of the computed part, plane by plane.
  std::vector<loads::PlaneContact> of_points(const Field& x) const;
  loads::EllipsoidContact affine_contact(const loads::Plane& plane, const Eigen::VectorXd& q) const;
  void spread(Field& by_point, Eigen::VectorXd& f) const;
  void spread(const loads::AffineForce& force, Eigen::VectorXd& f) const;

  loads::Planes planes_;
  std::shared_ptr<const PolynomialSpace> space_;
  Eigen::Matrix3d S_;
  PointTables tables_;
  std::vector<std::size_t> places_;  ///< of the points in the tables, without those that fill them up
  std::vector<double> weights_;      ///< of the computed part
  std::vector<double> largest_;  ///< max|φ_a| at the points, of each coefficient; 0 of constant and linear functions
};

}  // namespace pseudorigid::polynomial
