#pragma once
/// The columns of a rigid body. R is the rotation, Ω the angular velocity in the body, and A the inertia operator. The
/// mass is m, and the centre of mass has the position x. The columns have the angular velocity ω and the angular
/// momentum J in space, the kinetic energy K and the potential energy V:
///
///   ω = RΩ,   J = RAΩ (+ m x × ẋ of a free body),   K = ½Ω·AΩ (+ ½m|ẋ|²),   V the potential of weight and springs.

#include <fmt/format.h>

#include <Eigen/Dense>
#include <string_view>
#include <vector>

#include "systems/body_loads.h"
#include "systems/euler_angles.h"
#include "systems/system_scene.h"

namespace pseudorigid::systems {

/// The rotation of a rigid body, and the motion of its centre of mass, at one time.
struct BodyMotion {
  Eigen::Matrix3d R;
  Eigen::Vector3d Omega, x, velocity;  ///< Ω in the body; position and velocity of the centre of mass
};

/// Computes the columns from a motion, in the same way for every form of the equations.
class BodyObserver {
 public:
  /// A is the inertia operator about the fixed point, or about the centre of mass if the body does not have a fixed
  /// point. With a fixed point, the kinetic energy is ½Ω·AΩ. Otherwise ½m|ẋ|² is added.
  BodyObserver(const Eigen::Matrix3d& A, const BodyLoads& loads, bool fixed_point)
      : A_(A), loads_(loads), fixed_point_(fixed_point) {}

  static std::vector<Column> columns() {
    std::vector<Column> columns;
    for (int i = 1; i <= 3; ++i)
      for (int j = 1; j <= 3; ++j)
        columns.push_back({fmt::format("R{}{}", i, j), "", "rotation: the body point X is at R X, plus x if free"});
    const auto add = [&](const char* letter, Unit unit, std::string_view documentation) {
      for (int i = 1; i <= 3; ++i) columns.push_back({fmt::format("{}{}", letter, i), unit, documentation});
    };
    const Unit energy = "mass*length^2/time^2", momentum = "mass*length^2/time";
    add("Omega", "1/time", "angular velocity in the body");
    add("omega", "1/time", "angular velocity in space, R Omega");
    columns.insert(
        columns.end(),
        {{"phi", "", "Euler angle of R = Rz(phi) Rx(theta) Rz(psi): precession, radians, -pi to pi"},
         {"theta", "", "Euler angle: nutation, 0 to pi"},
         {"psi", "", "Euler angle: spin, -pi to pi; 0 if theta is 0 or pi, and phi then has all of the turn"},
         {"kinetic", energy, "kinetic energy"},
         {"potential", energy, "potential energy of weight and springs"},
         {"energy", energy, "their sum"}});
    add("J", momentum, "angular momentum in space, about its origin");
    add("J_body", momentum, "angular momentum in the body, A Omega, about its origin");
    add("x", "length", "centre of mass in space");
    add("v", "length/time", "its velocity");
    return columns;
  }

  /// Appends the values of the columns in the order of columns().
  void append(const BodyMotion& motion, std::vector<double>& row) const {
    const Eigen::Matrix3d& R = motion.R;
    const Eigen::Vector3d &Omega = motion.Omega, &x = motion.x, &velocity = motion.velocity;
    const Eigen::Vector3d P = A_ * Omega, omega = R * Omega;
    Eigen::Vector3d p = R * P;
    double K = 0.5 * Omega.dot(P);
    if (!fixed_point_) {
      p += loads_.mass * x.cross(velocity);
      K += 0.5 * loads_.mass * velocity.squaredNorm();
    }
    const Eigen::Vector3d origin = fixed_point_ ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : x;
    const double V =
        loads_.potential_energy([&](const Eigen::Vector3d& xi) { return Eigen::Vector3d(R * xi + origin); });
    const EulerAngles a = euler_angles_of(R);
    for (int i = 0; i < 3; ++i) row.insert(row.end(), {R(i, 0), R(i, 1), R(i, 2)});
    for (const Eigen::Vector3d& w : {Omega, omega}) row.insert(row.end(), w.begin(), w.end());
    row.insert(row.end(), {a.phi, a.theta, a.psi, K, V, K + V});
    for (const Eigen::Vector3d& w : {p, P, x, velocity}) row.insert(row.end(), w.begin(), w.end());
  }

 private:
  Eigen::Matrix3d A_;
  BodyLoads loads_;
  bool fixed_point_;
};

}  // namespace pseudorigid::systems
