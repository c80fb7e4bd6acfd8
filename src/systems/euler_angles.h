#pragma once
/// Euler angles (Oliva, Geometric Mechanics, 5.6.20). In the book, the first component of Ω has ψ̇ in place of θ̇,
/// which is a misprint. The rotation is R = R_z(φ) R_x(θ) R_z(ψ). The angular velocities Ω in the body and ω in space
/// are
///
///   Ω = (φ̇ sinθ sinψ + θ̇ cosψ,  φ̇ sinθ cosψ − θ̇ sinψ,  φ̇ cosθ + ψ̇)
///   ω = (θ̇ cosφ + ψ̇ sinφ sinθ,  θ̇ sinφ − ψ̇ cosφ sinθ,  φ̇ + ψ̇ cosθ)
///
/// The angles are columns of the output, and they are the coordinates of lagrange_top.h. The chart is singular at sin θ
/// = 0, where only φ + ψ or φ − ψ is defined.

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace pseudorigid::systems {

/// The three angles in radians, or their rates.
struct EulerAngles {
  double phi = 0, theta = 0, psi = 0;
};

inline Eigen::Matrix3d rotation_of(const EulerAngles& a) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return (AngleAxisd(a.phi, Vector3d::UnitZ()) * AngleAxisd(a.theta, Vector3d::UnitX()) *
          AngleAxisd(a.psi, Vector3d::UnitZ()))
      .toRotationMatrix();
}
inline Eigen::Vector3d body_angular_velocity(const EulerAngles& a, const EulerAngles& rate) {
  return {rate.phi * std::sin(a.theta) * std::sin(a.psi) + rate.theta * std::cos(a.psi),
          rate.phi * std::sin(a.theta) * std::cos(a.psi) - rate.theta * std::sin(a.psi),
          rate.phi * std::cos(a.theta) + rate.psi};
}
/// The rates of the angles for the angular velocity Ω in the body. Requires sin θ ≠ 0.
inline EulerAngles rates_of(const EulerAngles& a, const Eigen::Vector3d& Omega) {
  const double phi_rate = (Omega.x() * std::sin(a.psi) + Omega.y() * std::cos(a.psi)) / std::sin(a.theta);
  return {phi_rate, Omega.x() * std::cos(a.psi) - Omega.y() * std::sin(a.psi),
          Omega.z() - phi_rate * std::cos(a.theta)};
}

/// The angles of R, with θ from 0 to π and with φ and ψ from −π to π. If sin θ is 0 up to round-off, only φ + ψ or φ −
/// ψ is defined. The result then has ψ = 0, and φ is this sum or difference.
inline EulerAngles euler_angles_of(const Eigen::Matrix3d& R) {
  const double sin_theta = std::hypot(R(2, 0), R(2, 1));
  // φ and ψ have the round-off ε/sin θ with the machine precision ε. If sin θ is below this constant, φ and ψ have less
  // than three correct digits.
  constexpr double smallest_sine = 2e-13;
  if (!(sin_theta > smallest_sine)) return {std::atan2(R(1, 0), R(0, 0)), R(2, 2) > 0 ? 0 : std::numbers::pi, 0};
  return {std::atan2(R(0, 2), -R(1, 2)), std::atan2(sin_theta, R(2, 2)), std::atan2(R(2, 0), R(2, 1))};
}

}  // namespace pseudorigid::systems
