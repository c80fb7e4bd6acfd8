#pragma once
/// The reference body B of x = Q X: its inertia E₀ = ∫ρXXᵀdV (Oliva 5.7.2), volume and mass. If B is an ellipsoid, the
/// linear map S takes the unit ball to B. The semi-axes of the ellipsoid Q B are then the singular values of Q S.
///
///   ball of radius r:  E₀ = (4/15)πρr⁵ Id,     ellipsoid:  E₀ = (M/5) SSᵀ,   M = (4/3)πρ det S
///
/// M is the mass. All quantities are in internal units, with ρ = 1.

#include <Eigen/Dense>
#include <numbers>

namespace pseudorigid::reduced {

struct ReferenceBody {
  Eigen::Matrix3d E0;
  double volume;
  double mass = volume;  ///< equal to the volume, because ρ = 1
  /// The map S of B. If B is not an ellipsoid, S is the map of the ellipsoid with the inertia and the mass of B.
  Eigen::Matrix3d shape = Eigen::Matrix3d::Identity();

  /// The ball of the internal units: r = ρ = 1.
  static ReferenceBody unit_ball() {
    return {4.0 / 15.0 * std::numbers::pi * Eigen::Matrix3d::Identity(), 4.0 / 3.0 * std::numbers::pi};
  }
  /// The ellipsoid with these semi-axes along the coordinate axes.
  static ReferenceBody ellipsoid(const Eigen::Vector3d& a) {
    if (a == Eigen::Vector3d::Ones()) return unit_ball();
    const double volume = 4.0 / 3.0 * std::numbers::pi * a.prod();
    return {volume / 5 * Eigen::Matrix3d(a.cwiseAbs2().asDiagonal()), volume, volume, a.asDiagonal()};
  }
  /// A body of any shape with this inertia and volume. E₀ must be symmetric and positive definite. `shape` is the
  /// symmetric square root of (5/M) E₀.
  static ReferenceBody of_inertia(const Eigen::Matrix3d& E0, double volume);
};

}  // namespace pseudorigid::reduced
