#pragma once
/// Contact of the finite-element ball with rigid planes (loads/plane.h), by Gauss points on the faces of the free
/// surface:
///
///   V = Σ_planes Σ_points w k d²/2,   d = z₀ − n·x,   x = Σ φ_m x_m,   f_m = −∂V/∂x_m = Σ w k d n φ_m,
///
/// w the reference area of a point. The sums are factorised on each face. Faces that no polynomial through their nodes
/// brings to the plane are left out. With the Lebesgue constant Λ of the nodes at the points,
///
///   n·x ≥ (max + min)/2 − Λ² (max − min)/2   over the nodes of the face.
///
/// A sector has the contact of its own points; the planes as a whole are symmetric to its planes of reflection.

#include <Eigen/Core>
#include <vector>

#include "continuum/mesh/surface_faces.h"
#include "loads/contact.h"

namespace pseudorigid::continuum {

/// Points in a direction of a face: 2(k + 1), more than the nodes, since the edge of the contact is within faces.
int n_contact_points(const BallSpace& space);

class ContactForces {
 public:
  ContactForces(const loads::Planes& planes, const BallSpace& space, int n_points);

  /// f ← f − ∂V/∂x. Collective.
  void add(const Vector& x, Vector& f) const;
  /// f ← f + the force of the damping; returns the power that it takes from the computed sector. Collective.
  double add_damping(const Vector& x, const Vector& v, Vector& f) const;
  /// f ← f − ∂/∂x of ½k∮|x − x₀|², as if planes on all sides held every point at x₀. Collective.
  void add_holding(const Vector& x, const Vector& x0, Vector& f) const;
  /// The contact of the whole ball. Collective.
  loads::Contact contact(const Vector& x) const;

 private:
  struct Face {
    std::vector<unsigned int> nodes;  ///< [j·n + i], i along p
    Eigen::MatrixXd weights;          ///< reference area of the points: [p][q]
  };

  /// n·u − offset at the nodes of a face.
  Eigen::MatrixXd along(const loads::Plane& plane, double offset, const Face& face, const Vector& u) const;
  Eigen::MatrixXd at_points(const Eigen::MatrixXd& nodal) const {
    const Eigen::MatrixXd half = values_.lazyProduct(nodal);
    return half.lazyProduct(values_.transpose());
  }
  bool may_touch(const Eigen::MatrixXd& heights) const;
  /// f ← f + the forces of pressures w p at the points along n.
  void spread(const Eigen::MatrixXd& pressures, const Eigen::Vector3d& normal, const Face& face, Vector& f) const;

  loads::Planes planes_;
  const BallSpace& space_;
  Eigen::MatrixXd values_;  ///< ℓ_i at the points: [point][i]
  double lebesgue_;         ///< Λ
  std::vector<Face> faces_;
};

}  // namespace pseudorigid::continuum
