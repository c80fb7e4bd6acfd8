#pragma once
/// The reference body B of x = Q X: its inertia E₀ = ∫ρXXᵀdV (Oliva 5.7.2), volume and mass, and the linear map S that
/// takes the unit ball to B if B is an ellipsoid, so that Q B is the ellipsoid with the principal axes of Q S.
///
///   ball of radius r:  E₀ = (4/15)πρr⁵ Id,     ellipsoid:  E₀ = (M/5) SSᵀ,   M = (4/3)πρ det S
///
/// All in internal units, ρ = 1.

#include <Eigen/Dense>
#include <numbers>

namespace pseudorigid::reduced {

struct ReferenceBody {
  Eigen::Matrix3d E0;
  double volume;
  double mass = volume;                                 ///< ρ = 1
  Eigen::Matrix3d shape = Eigen::Matrix3d::Identity();  ///< S; of another body, that of the ellipsoid with its E₀

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
  /// Any other body, of which only inertia and volume are known. E₀ is symmetric and positive definite.
  static ReferenceBody of_inertia(const Eigen::Matrix3d& E0, double volume);
};

}  // namespace pseudorigid::reduced
