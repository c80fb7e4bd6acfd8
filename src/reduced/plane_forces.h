#pragma once
/// Forces of rigid planes on a body x = c + Q X with the ellipsoidal reference shape X = S ξ, |ξ| ≤ 1
/// (loads/ellipsoid_contact.h). The forces F act on Q and on the centre of mass c. The planes may move along their
/// normals.

#include <numbers>
#include <utility>
#include <vector>

#include "loads/ellipsoid_friction.h"
#include "mechanics/core/linearization.h"

namespace pseudorigid::reduced {

class PlaneForces {
  using Matrix = Eigen::Matrix3d;
  using Vector = Eigen::Vector3d;

 public:
  PlaneForces(loads::Planes planes, const Matrix& shape) : planes_(std::move(planes)), S_(shape) {}

  const loads::Planes& planes() const { return planes_; }

  /// Summary of the contacts with all planes at the time t (loads/contact.h).
  loads::Contact contact(double t, const Matrix& Q, const Vector& c) const {
    const loads::Planes now = planes_.at(t);
    std::vector<loads::PlaneContact> contacts;
    for (const loads::Plane& plane : now) contacts.push_back(contact_with(plane, Q, c).contact());
    return loads::summary(now, contacts);
  }
  /// Adds the pressure of contact to F. Returns the power that moving planes give through this pressure.
  double add_pressure(double t, const Matrix& Q, const Vector& c, loads::AffineForce& F) const {
    double given = 0;
    for (const loads::Plane& plane : planes_) {
      const loads::EllipsoidContact contact = contact_with(plane.at(t), Q, c);
      contact.add_force(F);
      given += contact.given();
    }
    return given;
  }
  /// Adds the damping of contact to F. Returns the power that the damping dissipates, and the power that moving planes
  /// give through the damping.
  loads::ContactPower add_damping(double t, const Matrix& Q, const Vector& c, const Matrix& Qdot, const Vector& cdot,
                                  loads::AffineForce& F) const {
    loads::ContactPower power;
    for (const loads::Plane& plane : planes_) power += contact_with(plane.at(t), Q, c).add_damping(Qdot, cdot, F);
    return power;
  }
  /// Adds the friction to F. Returns the power that the friction dissipates.
  double add_friction(double t, const Matrix& Q, const Vector& c, const Matrix& Qdot, const Vector& cdot,
                      loads::AffineForce& F) const {
    double taken = 0;
    if (!planes_.rough()) return taken;
    for (const loads::Plane& plane : planes_) {
      const loads::EllipsoidContact contact = contact_with(plane.at(t), Q, c);
      taken += loads::EllipsoidFriction(contact, Qdot, cdot).add_force(F);
    }
    return taken;
  }
  /// Adds the linearised change of the damping and the friction for changes U of Q̇ and u of ċ to F. The speeds of the
  /// planes do not change. `kind` is the linearisation of the friction (loads/friction.h).
  void add_damping_change(double t, const Matrix& Q, const Vector& c, const Matrix& Qdot, const Vector& cdot,
                          const Matrix& U, const Vector& u, mechanics::Linearization kind,
                          loads::AffineForce& F) const {
    for (const loads::Plane& plane : planes_) contact_with(plane.stopped_at(t), Q, c).add_damping(U, u, F);
    if (!planes_.rough()) return;
    for (const loads::Plane& plane : planes_) {
      const loads::EllipsoidContact contact = contact_with(plane.at(t), Q, c);
      loads::EllipsoidFriction(contact, Qdot, cdot).add_change(U, u, kind, F);
    }
  }
  /// Adds −k∮u to the force on c and −k∮u Xᵀ to the force on Q, with k = Planes::stiffness_of_all(). The arguments Q
  /// and c are differences of two configurations, so that u = c + Q X is the displacement. The integrals are over the
  /// unit sphere of ξ, with X = S ξ.
  void add_springs(const Matrix& Q, const Vector& c, loads::AffineForce& F) const {
    const double k = planes_.stiffness_of_all(), area = 4 * std::numbers::pi;
    F.on_center -= k * area * c;
    F.on_Q -= k * area / 3 * Q * S_ * S_.transpose();
  }

 private:
  loads::EllipsoidContact contact_with(const loads::Plane& plane, const Matrix& Q, const Vector& c) const {
    return {plane, S_, Q, c};
  }

  loads::Planes planes_;
  Matrix S_;
};

}  // namespace pseudorigid::reduced
