#pragma once
/// Friction of a plane on an ellipsoid x = c + Q S ξ, |ξ| = 1, as a sum over the part of the sphere that is in contact.
/// The reference shape is S, the affine deformation Q and the centre c. The plane (plane.h) has the unit normal n, the
/// stiffness k and the slip speed s. Let g = SᵀQᵀn, G = |g| and ĝ = g/G, and let δ be the largest penetration. The
/// points and their penetration d are
///
///   ξ = −(1 − τ) ĝ + √(τ(2 − τ)) (e₁ cos φ + e₂ sin φ),   d = δ − G τ,   0 ≤ τ ≤ min(2, δ/G),   dA = dτ dφ,
///
/// with unit vectors e₁ and e₂ that are orthogonal to ĝ and to each other. With the traction F of the friction for the
/// pressure k d (friction.h), the forces are
///
///   on c  ∫F dA,   on Q  ∫F (S ξ)ᵀ dA.
///
/// The integrals are sums over 8 Gauss points in τ and n_angles equidistant angles φ. The sums are exact if F/(k d) is
/// a polynomial of ξ with at most degree 13. F is smooth, but varies over distances at which the tangential velocity
/// v_t changes by s. If v_t vanishes within the contact and changes by more than s, the error of the sums is larger
/// (docs/contact.md has numbers). The vector e₁ is parallel to the part of (QS)ᵀa that is orthogonal to ĝ. Here a is a
/// tangent vector of the plane that is fixed in space. If a ball rotates rigidly, the points therefore remain fixed
/// relative to its centre.

#include <array>
#include <cmath>
#include <numbers>

#include "loads/ellipsoid_contact.h"
#include "loads/friction.h"
#include "mechanics/core/gauss_coefficients.h"

namespace pseudorigid::loads {

class EllipsoidFriction {
 public:
  static constexpr int n_angles = 16;

  /// Sets the velocities Qdot and cdot at which the friction is evaluated. The object keeps references to the
  /// arguments, which must outlive it.
  EllipsoidFriction(const EllipsoidContact& contact, const Eigen::Matrix3d& Qdot, const Eigen::Vector3d& cdot)
      : contact_(contact), Qdot_(Qdot), cdot_(cdot) {}

  /// Adds the friction to f. Returns the power that the friction dissipates.
  double add_force(AffineForce& f) const {
    double power = 0;
    for_each_point([&](const Eigen::Vector3d& X, double pressure) {
      const Friction friction(contact_.plane(), cdot_ + Qdot_ * X);
      add(friction.traction(pressure), X, f);
      power += friction.power(pressure);
    });
    return power;
  }
  /// Adds the linearised change of the friction for changes dQdot and dcdot of the velocities to f. `kind` chooses one
  /// of the two linearisations of friction.h.
  void add_change(const Eigen::Matrix3d& dQdot, const Eigen::Vector3d& dcdot, mechanics::Linearization kind,
                  AffineForce& f) const {
    for_each_point([&](const Eigen::Vector3d& X, double pressure) {
      const Friction friction(contact_.plane(), cdot_ + Qdot_ * X);
      add(friction.change(pressure, dcdot + dQdot * X, kind), X, f);
    });
  }

 private:
  static void add(const Eigen::Vector3d& force, const Eigen::Vector3d& X, AffineForce& f) {
    f.on_center += force;
    f.on_Q += force * X.transpose();
  }

  /// Calls visit(X, p) for the points X = S ξ of the sum. p is the pressure k d times the weight of the point. Does
  /// nothing without contact or without friction.
  template <class Visit>
  void for_each_point(Visit&& visit) const {
    const Plane& plane = contact_.plane();
    if (!contact_.touches() || plane.friction == 0) return;
    static const std::array<Eigen::Vector2d, n_angles> circle = [] {
      std::array<Eigen::Vector2d, n_angles> points;
      for (int j = 0; j < n_angles; ++j) {
        const double phi = 2 * std::numbers::pi * j / n_angles;
        points[j] = {std::cos(phi), std::sin(phi)};
      }
      return points;
    }();
    const Eigen::Vector3d& g = contact_.direction();
    const Eigen::Vector3d image =
        contact_.shape().transpose() * (contact_.deformation().transpose() * plane.normal.unitOrthogonal());
    const Eigen::Vector3d e1 = (image - g.dot(image) * g).normalized(), e2 = g.cross(e1);
    const double T = std::min(2.0, contact_.deepest() / contact_.slope());
    for (int i = 0; i < mechanics::gauss::n_stages; ++i) {
      const double tau = T * static_cast<double>(mechanics::gauss::c[i]), radius = std::sqrt(tau * (2 - tau));
      const double d = contact_.deepest() - contact_.slope() * tau;
      const double weight = 2 * std::numbers::pi / n_angles * T * static_cast<double>(mechanics::gauss::b[i]);
      for (const Eigen::Vector2d& at : circle)
        visit(contact_.shape() * (radius * (at[0] * e1 + at[1] * e2) - (1 - tau) * g), weight * plane.stiffness * d);
    }
  }

  const EllipsoidContact& contact_;
  const Eigen::Matrix3d& Qdot_;
  const Eigen::Vector3d& cdot_;
};

}  // namespace pseudorigid::loads
