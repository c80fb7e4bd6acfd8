#pragma once
/// Contact of the finite-element ball with rigid planes (loads/plane.h), by Gauss quadrature on the faces of the free
/// surface:
///
///   V = Σ_planes Σ_points w k d²/2,   d = z₀ − n·x,   x = Σ φ_m x_m,   f_m = −∂V/∂x_m = Σ w k d n φ_m,
///
/// with the stiffness k and the unit normal n of a plane n·x = z₀(t). Damping and friction are sums over the same
/// points. Only points with d > 0 count. The weight w of a point is its share of the reference area. Node m has the
/// basis function φ_m and the position x_m. The sums are factorised on each face. A face is skipped if a bound shows
/// that its points do not reach the plane. Let ℓ_i be the Lagrange polynomials of the one-dimensional nodes, and Λ =
/// max_q Σ_i |ℓ_i(ξ_q)| their Lebesgue constant at the points ξ_q. With the maximum and minimum of n·x at the nodes of
/// the face, the bound is
///
///   n·x ≥ (max + min)/2 − Λ² (max − min)/2.
///
/// In a sector, the forces act on the points of the sector only. The set of planes must have the symmetry of the
/// sector.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "continuum/mesh/surface_faces.h"
#include "loads/contact.h"
#include "mechanics/core/linearization.h"

namespace pseudorigid::continuum {

/// Number of points in each direction of a face: 2(k + 1), with the degree k. There are more points than nodes, because
/// the pressure is not smooth at the edge of the contact area. This edge lies inside faces.
int n_contact_points(const BallSpace& space);

class ContactForces {
 public:
  ContactForces(const loads::Planes& planes, const BallSpace& space, int n_points);

  /// f ← f − ∂V/∂x. Returns the power that moving planes transmit by this force, for the computed sector on all ranks.
  /// Collective.
  double add(double t, const Vector& x, Vector& f) const;
  /// f ← f + damping force and friction of the planes (loads/plane.h). Returns the power that these forces dissipate
  /// and the power that moving planes transmit by them, for the computed sector on all ranks. Collective.
  loads::ContactPower add_dissipation(double t, const Vector& x, const Vector& v, Vector& f) const;
  /// f ← f − C u. C is the linearisation `kind` of damping and friction at the position x and the velocity v
  /// (mechanics/core/damping.h). Collective.
  void add_damping(double t, const Vector& x, const Vector& v, const Vector& u, mechanics::Linearization kind,
                   Vector& f) const;
  /// f ← f − ∂/∂x of ½k∮|x − x₀|², with k = Planes::stiffness_of_all(). The springs pull each point of the surface to
  /// the place that it has for the nodal positions x₀. Collective.
  void add_holding(const Vector& x, const Vector& x0, Vector& f) const;
  /// The values of the output columns for the contact of the whole ball at the time t. Collective.
  loads::Contact contact(double t, const Vector& x) const;

 private:
  struct Face {
    std::vector<unsigned int> nodes;  ///< local numbers: node (i, j) at j·n + i, for n nodes in each direction
    Eigen::MatrixXd weights;          ///< reference areas w of the points: [index along p][index along q]
  };

  /// n·u − offset at the nodes of a face, with the normal n of the plane. Entry (i, j) belongs to the node with the
  /// index i along the local direction p of the face and j along q (mesh/surface_faces.h).
  Eigen::MatrixXd along(const loads::Plane& plane, double offset, const Face& face, const Vector& u) const;
  /// Interpolates values at the nodes of a face to its points. In both matrices, the row is the index along p, and the
  /// column is the index along q.
  Eigen::MatrixXd at_points(const Eigen::MatrixXd& nodal) const {
    const Eigen::MatrixXd half = values_.lazyProduct(nodal);
    return half.lazyProduct(values_.transpose());
  }
  /// False if the bound in the opening comment of this file shows that the face does not reach the plane. `heights`
  /// contains n·x − z₀ at the nodes.
  bool may_touch(const Eigen::MatrixXd& heights) const;
  /// The three components of a vector field at the points of a face, in the order of Face::weights.
  using VectorAtPoints = std::array<Eigen::MatrixXd, 3>;
  VectorAtPoints vector_at_points(const Face& face, const Vector& u) const;
  /// Calls visit(face, heights) for the faces of this rank with a point in contact. `heights` contains n·x − z₀ at all
  /// points of the face.
  template <class Visit>
  void for_touching_faces(const loads::Plane& plane, const Vector& x, Visit&& visit) const;
  /// f ← f + damping force at the velocity u. `planes` is a result of Planes::at or Planes::stopped_at. Returns the
  /// powers of this force on this rank.
  loads::ContactPower add_plane_damping(const loads::Planes& planes, const Vector& x, const Vector& u, Vector& f) const;
  /// Adds forces of friction to f. traction_on(plane, face) returns a function for the points of the face. Its
  /// arguments are the index of a point and the product w k d at this point. Its result is the force of the point,
  /// which includes the weight w.
  template <class TractionOn>
  void add_tractions(const loads::Planes& planes, const Vector& x, TractionOn&& traction_on, Vector& f) const;
  /// f_m ← f_m + Σ_points w p φ_m n with the pressure p. `pressures` contains the products w p of the points, in the
  /// order of Face::weights.
  void spread(const Eigen::MatrixXd& pressures, const Eigen::Vector3d& normal, const Face& face, Vector& f) const;

  loads::Planes planes_;
  const BallSpace& space_;
  Eigen::MatrixXd values_;  ///< Lagrange polynomials ℓ_i at the points: [point][i]
  double lebesgue_;         ///< Lebesgue constant Λ
  std::vector<Face> faces_;
};

}  // namespace pseudorigid::continuum
