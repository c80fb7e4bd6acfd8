#pragma once
/// Self-gravity of the homogeneous ellipsoid F B, the image of the unit ball B under the matrix F (docs/oliva.md,
/// correction 8; Carlson's form of Chandrasekhar's integrals). G is the gravitational constant and M the mass. The
/// singular value decomposition is F = U diag(a) Wᵀ, with the semi-axes a_i. Let κ = (3/5) G M², A = UᵀF and
/// x_i = a_i². With the integrals d_i and t_k of ellipsoid_integrals.h, the potential energy V and its derivative are
///
///   V = −κ R_F(x_1, x_2, x_3) = −(κ/3) Σ x_i d_i,      ∂V/∂F = (κ/3) U diag(d) A = (κ/3) U diag(d) Uᵀ F.
///
/// Let ĥ = UᵀH, and let ċ = ĥAᵀ + Aĥᵀ be the derivative of FFᵀ along Ḟ = H, in the frame of the principal axes. The
/// derivative of ∂V/∂F along H is, for different indices i, j, k,
///
///   D(∂V/∂F)[H] = (κ/3) U (gA + diag(d)ĥ),   g_ij = −t_k ċ_ij,   g_ii = −(3/2) t_ii ċ_ii − ½ Σ_{j≠i} t_k ċ_jj,
///   x_i t_ii = d_i − ⅓ Σ_{j≠i} x_j t_k    (Euler's identity; at least ⅓ d_i, so that there is no cancellation).
///
/// The formulas do not divide by differences of the semi-axes, so semi-axes may be equal. The derivative ∂V/∂F is
/// computed from the products d_i A_i with the rows A_i of A, and not from (U diag(d) Uᵀ) F. Both forms are equal in
/// exact arithmetic. For a flat body, the products d_i A_i have relative errors of the round-off ε, and the other form
/// has relative errors of cond(F)·ε. For the same reason, the computed force changes the angular momentum and the
/// circulation by round-off only. V is homogeneous of degree −1 in F. Therefore very large or small F are scaled by a
/// power of two, which avoids overflow of squares and does not cause rounding errors.

#include <Eigen/Core>
#include <cmath>

#include "gravity/ellipsoid_integrals.h"
#include "mechanics/core/principal_axes.h"

namespace pseudorigid::gravity {

struct EllipsoidGravity {
  double strength;  ///< the factor κ = (3/5) G M²

  /// Returns the potential energy V of the ellipsoid F B. F must be a regular matrix.
  double energy(const Eigen::Matrix3d& F) const {
    const double scale = unit_scale(F);
    const auto axes = mechanics::principal_axes(scale * F);
    return -strength / 3 * scale * axes.a.cwiseAbs2().dot(ellipsoid_integrals<false>(axes.a).d);
  }

  /// Returns the derivative ∂V/∂F of the potential energy. F must be regular.
  Eigen::Matrix3d gradient(const Eigen::Matrix3d& F) const {
    const double scale = unit_scale(F);
    const auto [U, A, a] = mechanics::principal_axes(scale * F);
    const Eigen::Vector3d d = ellipsoid_integrals<false>(a).d;
    return scale * (strength / 3 * scale * mechanics::detail::axes::product(U, d.asDiagonal() * A));
  }

  /// Returns the derivative D(∂V/∂F)[H] of ∂V/∂F in the direction H. F must be regular.
  Eigen::Matrix3d second_derivative(const Eigen::Matrix3d& F, const Eigen::Matrix3d& H) const {
    const double scale = unit_scale(F);
    const auto [U, A, a] = mechanics::principal_axes(scale * F);
    const auto [d, t] = ellipsoid_integrals(a);
    const Eigen::Matrix3d h = U.transpose() * (scale * H), half = h * A.transpose(), c = half + half.transpose();
    const Eigen::Vector3d x = a.cwiseAbs2();
    Eigen::Matrix3d g;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const double t_ii = (d[i] - (x[j] * t[k] + x[k] * t[j]) / 3) / x[i];
      g(i, i) = -(1.5 * t_ii * c(i, i) + 0.5 * (t[k] * c(j, j) + t[j] * c(k, k)));
      g(i, j) = g(j, i) = -t[k] * c(i, j);
    }
    return scale * (strength / 3 * scale * U * (g * A + d.asDiagonal() * h));
  }

 private:
  /// Returns the factor by which F is scaled. Let m be the largest absolute value of the entries of F. If m is between
  /// 2⁻²⁰ and 2²⁰, the factor is 1. Otherwise the factor is the power of two that brings m into [½, 1).
  static double unit_scale(const Eigen::Matrix3d& F) {
    const double largest = F.cwiseAbs().maxCoeff();
    if (largest > 0x1p-20 && largest < 0x1p+20) return 1;
    int exponent = 0;
    std::frexp(largest, &exponent);
    return std::ldexp(1.0, -exponent);
  }
};

}  // namespace pseudorigid::gravity
