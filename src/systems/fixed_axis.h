#pragma once
/// A rigid body that rotates about a fixed axis (Oliva, Geometric Mechanics, 5.6.10). The axis has the unit vector e
/// and passes through the origin of the body; ê is the matrix of e×. The body has the mass m, the centre of mass G and
/// the inertia operator A about the origin. Gravity has the acceleration g, and the bearings exert the friction torque
/// −cθ̇. The angle θ satisfies
///
///   I_e θ̈ = m⟨e, G × R⁻¹g⟩ − cθ̇,   R = exp(θê),   I_e = ⟨Ae, e⟩,   V = −m⟨g, RG⟩
///
/// with the rotation R, the moment of inertia I_e about the axis and the potential V of the weight.
///
/// Bearings at the points a e and b e support the axis. Let F be the total force of the bearings, and N their total
/// torque about the origin. In the axes of the body, with ω = θ̇e and ω̇ = θ̈e,
///
///   F = m[ω̇ × G + ω × (ω × G) − R⁻¹g],   N = Aω̇ + ω × Aω − G × mR⁻¹g.
///
/// The forces f_a and f_b of the bearings satisfy f_a + f_b = F, ae × f_a + be × f_b = N − ⟨N, e⟩e. The components of
/// these forces perpendicular to the axis (⊥) are
///
///   f_b^⊥ = −(e × N + aF^⊥)/(b − a),   f_a^⊥ = F^⊥ − f_b^⊥.
///
/// Only the sum of the components along the axis is determined. The program assigns this sum to the first bearing. If e
/// is a principal axis through the centre of mass, the bearings carry only the weight at any speed.

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "mechanics/core/automatic_differentiation.h"
#include "systems/mass_distribution.h"
#include "systems/systems_in_lanes.h"

namespace pseudorigid::systems {

/// The equation of motion in the head of this file, in the chart with the angle θ as its only coordinate.
struct FixedAxis {
  static constexpr int dimension = 1;
  MassDistribution body;
  /// The unit vector e of the axis, and the acceleration g of gravity in space.
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ(), gravity = Eigen::Vector3d::Zero();
  double friction = 0;  // friction coefficient c

  double moment_of_inertia() const { return axis.dot(inertia_operator(body.E0) * axis); }  ///< I_e, about the axis

  template <class T>
  Eigen::Matrix<T, 1, 1> metric(const mechanics::Coordinates<T, 1>&) const {
    return Eigen::Matrix<T, 1, 1>(T(moment_of_inertia()));
  }
  template <class T>
  T potential(const mechanics::Coordinates<T, 1>& q) const {
    using std::cos, std::sin;
    const Eigen::Vector3d along = axis.dot(body.center) * axis, across = body.center - along,
                          ahead = axis.cross(body.center);
    return -body.mass * (gravity.dot(along) + gravity.dot(across) * cos(q[0]) + gravity.dot(ahead) * sin(q[0]));
  }
  using Angle = Eigen::Matrix<double, 1, 1>;
  /// The angular acceleration −cθ̇/I_e that the friction causes.
  template <class T>
  Eigen::Matrix<T, 1, 1> dissipation(const Eigen::Matrix<T, 1, 1>&, const Eigen::Matrix<T, 1, 1>& v) const {
    return Eigen::Matrix<T, 1, 1>(T(-friction / moment_of_inertia() * v[0]));
  }
  Angle periods() const { return Angle(2 * std::numbers::pi); }

  Eigen::Matrix3d rotation(double angle) const { return Eigen::AngleAxisd(angle, axis).toRotationMatrix(); }
};

/// Forces of the bearings on the body, in the axes of the body.
struct BearingForces {
  Eigen::Vector3d first, second;
};
/// The forces of the bearings for the angle θ (`angle`) and its first and second derivatives. The numbers `first` = a
/// and `second` = b are the places of the bearings along the axis, a ≠ b.
inline BearingForces bearing_forces(const FixedAxis& system, double first, double second, double angle, double rate,
                                    double acceleration) {
  const auto& [m, G, E0] = system.body;
  const Eigen::Matrix3d A = inertia_operator(E0);
  const Eigen::Vector3d e = system.axis, omega = rate * e, omega_dot = acceleration * e,
                        g = system.rotation(-angle) * system.gravity;
  const Eigen::Vector3d F = m * (omega_dot.cross(G) + omega.cross(omega.cross(G)) - g),
                        N = A * omega_dot + omega.cross(A * omega) - m * G.cross(g);
  const Eigen::Vector3d F_across = F - F.dot(e) * e, f_second = -(e.cross(N) + first * F_across) / (second - first);
  return {F - f_second, f_second};
}

}  // namespace pseudorigid::systems
