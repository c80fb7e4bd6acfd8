#pragma once
/// Steady motions of a body with given semi-axes a₁, a₂, a₃, in closed form for every isotropic potential V on SL(3).
/// steady_motion.h defines the angular velocity ω of the axes, the internal rotation Λ, the multiplier λ per m̄ and the
/// residual R. The body has the inertia m̄ Id.
///
/// The entries of R off the diagonal do not contain the potential. They vanish if
/// ω_iω_ja_j − 2a_kω_jΛ_i + a_iΛ_iΛ_j = 0 for i ≠ j, with the third index k. If the axes are different, ω and Λ
/// therefore lie along one axis or in one principal plane (Riemann).
///
/// Type S: ω and Λ lie along axis 3, and the equations contain their components. Let V_i = ∂V/∂a_i per m̄, ∂²V[·] the
/// second derivative per m̄, and E_ij the matrix with 1 at ij and 0 elsewhere. Because rotations do not change V, (a₁V₁
/// − a₂V₂)/(a₁² − a₂²) = E₂₁:∂²V[E₂₁] and (a₂V₁ − a₁V₂)/(a₁² − a₂²) = E₁₂:∂²V[E₂₁]. The equations R = 0 are then
///   ω² + Λ² = E₂₁:∂²V[E₂₁],   2ωΛ = E₁₂:∂²V[E₂₁] + λ/(a₁a₂),   λ = a₃V₃.
///
/// These equations do not divide by a difference of axes. For the neo-Hookean law with the shear modulus μ, the two
/// right-hand sides are κ = 5μ/(ρr²) and κ/(a₁a₂)³. The reference ball has the density ρ and the radius r. For a fluid
/// they are the right-hand sides of Riemann, with the symbols A_i, A_ij and B_ij of Chandrasekhar,
///
///   2πGρB₁₂,   2πGρ(a₃²A₃ − a₁²a₂²A₁₂)/(a₁a₂).
///
/// Spheroid a₁ = a₂ rotating about axis 3: the motion depends only on Ω = ω − Λ. The choice Λ = 0 gives
///
///   Ω² = (1 − a₃²/a₁²) E₃₁:∂²V[E₃₁].
///
/// Types I–III: let ω = (0, ω₂, ω₃) and Λ = (0, βω₂, γω₃). Then R₂₃ = R₃₂ = 0 give a₃ − 2a₁β + a₂βγ = 0 and
/// a₂ − 2a₁γ + a₃βγ = 0, so that p = βγ satisfies
///
///   a₂a₃(p² + 1) + (a₂² + a₃² − 4a₁²)p = 0,   β = (a₃ + a₂p)/(2a₁),   γ = (a₂ + a₃p)/(2a₁).
///
/// The roots p and 1/p belong to dual motions (Dedekind). The roots are real for 2a₁ ≥ a₂ + a₃ (type I) and for 2a₁ ≤
/// |a₂ − a₃| (types II, III: Chandrasekhar §51). The equations R_ii = 0 are then linear in ω₂², ω₃² and λ.
///
/// On GL⁺(3), λ = 0. The same formulas hold for a body of given axis ratios, if its size is such that they give λ = 0.

#include <string>

#include "mechanics/core/bracketed_root.h"
#include "mechanics/core/dense_algebra.h"
#include "mechanics/core/status.h"
#include "reduced/steady_motion.h"

namespace pseudorigid::reduced {

using mechanics::bracketed_root;

/// The matrix with 1 at ij and 0 elsewhere.
inline Eigen::Matrix3d unit_matrix(int i, int j) {
  Eigen::Matrix3d E = Eigen::Matrix3d::Zero();
  E(i, j) = 1;
  return E;
}

/// Semi-axes with these ratios to a₁ and with the product 1, so that det diag(a) = 1.
inline Eigen::Vector3d axes_of_ratios(double a2_to_a1, double a3_to_a1) {
  return Eigen::Vector3d(1, a2_to_a1, a3_to_a1) / std::cbrt(a2_to_a1 * a3_to_a1);
}

/// Sets m to a steady motion of a body whose axes have the ratios of `axes`. motion(a, m) sets m to the motion with the
/// semi-axes a. On SL(3), a = axes, so the product of `axes` must be 1. On GL⁺(3), a = size · axes with the size
/// nearest to 1 at which the multiplier is 0. Fails if an axis is not positive, if `motion` fails, or if there is no
/// such size between 1/18 and 18. The function `motion` must set m.lambda even if it fails because the square of a
/// velocity is negative.
template <SmoothPotential V, class MotionOfAxes>
mechanics::Status motion_of_shape(const IsotropicBody<V>& body, const Eigen::Vector3d& axes, const MotionOfAxes& motion,
                                  SteadyMotion& m) {
  if (!(axes.minCoeff() > 0)) return mechanics::Status::failure("the semi-axes of a figure are positive");
  if (body.incompressible) return motion(axes, m);
  constexpr double factor = 1.05;
  constexpr int n_factors = 60;  // sizes from 1/18 to 18
  const auto multiplier = [&](double log_size) {
    SteadyMotion trial;
    (void)motion(std::exp(log_size) * axes, trial);
    return trial.lambda;
  };
  for (int k = 0; k < n_factors; ++k)
    for (const double side : {1.0, -1.0}) {
      const double step = side * std::log(factor);
      if (const auto log_size = bracketed_root(multiplier, k * step, (k + 1) * step)) {
        mechanics::Status status = motion(std::exp(*log_size) * axes, m);
        m.lambda = 0;
        return status;
      }
    }
  return mechanics::Status::failure("a free body has no steady motion of this shape at any size");
}

/// ω² + Λ², 2ωΛ and the multiplier per m̄ of a body with ω and Λ along axis 3.
struct TypeSSquares {
  double sum, twice_product, lambda;
};

/// The right-hand sides of the equations for type S in the head of this file, for the semi-axes a.
template <SmoothPotential V>
TypeSSquares type_s_squares(const IsotropicBody<V>& body, const Eigen::Vector3d& a) {
  const Eigen::Matrix3d A = a.asDiagonal(), D = body.second_derivative(A, unit_matrix(1, 0));
  const double lambda = a[2] * body.gradient(A)(2, 2);
  return {D(1, 0), D(0, 1) + lambda / (a[0] * a[1]), lambda};
}

/// Sets m to the motion of type S with the semi-axes a and ω ≥ |Λ|. Fails if (ω + Λ)² or (ω − Λ)² is negative beyond
/// round-off; m.A and m.lambda are then also set. In the dual motion ω and Λ are exchanged.
template <SmoothPotential V>
mechanics::Status type_s_motion(const IsotropicBody<V>& body, const Eigen::Vector3d& a, SteadyMotion& m) {
  const auto [sum, product, lambda] = type_s_squares(body, a);
  const double plus = sum + product, minus = sum - product;  // (ω + Λ)² and (ω − Λ)²
  m.A = a.asDiagonal();
  m.lambda = lambda;
  const double round_off = 1e-14 * (std::abs(sum) + std::abs(product));
  if (!(plus >= -round_off && minus >= -round_off))
    return mechanics::Status::failure(
        "no figure with these axes turns steadily about the third: (omega + Lambda)^2 = " +
        mechanics::six_digits(plus) + ", (omega - Lambda)^2 = " + mechanics::six_digits(minus));
  const double p = std::sqrt(std::max(plus, 0.0)), q = std::sqrt(std::max(minus, 0.0));
  m.omega = (p + q) / 2 * Eigen::Vector3d::UnitZ();
  m.Lambda = product / (p + q > 0 ? p + q : 1) * Eigen::Vector3d::UnitZ();  // p² − q² = 2 · 2ωΛ
  return {};
}

/// Sets m to the motion of the spheroid a = (a₁, a₁, a₃) that rotates about axis 3 with Λ = 0. Fails if Ω² is negative.
/// m.A and m.lambda are then also set.
template <SmoothPotential V>
mechanics::Status spheroid_motion(const IsotropicBody<V>& body, double a1, double a3, SteadyMotion& m) {
  m.A = Eigen::Vector3d(a1, a1, a3).asDiagonal();
  m.lambda = a3 * body.gradient(m.A)(2, 2);
  const double stiffness = body.second_derivative(m.A, unit_matrix(2, 0))(2, 0);
  const double square = (a1 - a3) * (a1 + a3) / (a1 * a1) * stiffness;
  if (!(square >= 0))
    return mechanics::Status::failure("this spheroid does not turn steadily about its axis: Omega^2 = " +
                                      mechanics::six_digits(square));
  m.omega = std::sqrt(square) * Eigen::Vector3d::UnitZ();
  m.Lambda.setZero();
  return {};
}

/// Sets m to the motion of types I–III with the semi-axes a, and with ω and Λ in the plane of axes 2 and 3. The
/// function uses the root p with |p| ≤ 1, and ω₂, ω₃ ≥ 0. Fails if p is not real, or if ω₂² or ω₃² is negative beyond
/// round-off. In the second case, m.A and m.lambda are also set. The dual motion belongs to the other root.
template <SmoothPotential V>
mechanics::Status planar_motion(const IsotropicBody<V>& body, const Eigen::Vector3d& a, SteadyMotion& m) {
  const double half = (4 * a[0] * a[0] - a[1] * a[1] - a[2] * a[2]) / (2 * a[1] * a[2]);  // p + 1/p = 2 half
  if (!(std::abs(half) >= 1))
    return mechanics::Status::failure(
        "no figure with these axes turns in the plane of axes 2 and 3: 2 a1 lies between |a2 - a3| and a2 + a3");
  const double p = std::copysign(1 / (std::abs(half) + std::sqrt((std::abs(half) - 1) * (std::abs(half) + 1))), half);
  const double beta = (a[2] + a[1] * p) / (2 * a[0]), gamma = (a[1] + a[2] * p) / (2 * a[0]);
  m.A = a.asDiagonal();
  const auto square_term = [&](int axis, double ratio) -> Eigen::Vector3d {
    const Eigen::Vector3d w = Eigen::Vector3d::Unit(axis);
    return detail::steady_acceleration(w, ratio * w, m.A).diagonal();
  };
  Eigen::Matrix3d system;
  system << square_term(1, beta), square_term(2, gamma), -a.cwiseInverse();
  const Eigen::Vector3d squares = mechanics::solve(system, -body.gradient(m.A).diagonal());
  m.lambda = squares[2];
  const double round_off = 1e-14 * (std::abs(squares[0]) + std::abs(squares[1]));
  if (!(squares[0] >= -round_off && squares[1] >= -round_off))
    return mechanics::Status::failure("no figure with these axes turns in the plane of axes 2 and 3: omega_2^2 = " +
                                      mechanics::six_digits(squares[0]) +
                                      ", omega_3^2 = " + mechanics::six_digits(squares[1]));
  const double w2 = std::sqrt(std::max(squares[0], 0.0)), w3 = std::sqrt(std::max(squares[1], 0.0));
  m.omega = {0, w2, w3};
  m.Lambda = {0, beta * w2, gamma * w3};
  return {};
}

/// Sets m to the motion of the body with the ratio a₂/a₁ that rotates about axis 3 with Λ = 0 (Jacobi's ellipsoid for a
/// fluid). The ratio a₃/a₁ is the largest ratio between 10⁻⁴ and 1 with 2ωΛ = 0 and ω² ≥ 0. Fails if there is no such
/// ratio. The dual motion is Dedekind's ellipsoid.
template <SmoothPotential V>
mechanics::Status jacobi_motion(const IsotropicBody<V>& body, double a2_to_a1, SteadyMotion& m) {
  constexpr double factor = 1.1, least_ratio = 1e-4;
  const auto shaped = [&](double ratio, SteadyMotion& motion) {
    return motion_of_shape(
        body, axes_of_ratios(a2_to_a1, ratio),
        [&](const Eigen::Vector3d& a, SteadyMotion& of_axes) { return type_s_motion(body, a, of_axes); }, motion);
  };
  const auto product = [&](double log_ratio) {
    SteadyMotion trial;
    (void)shaped(std::exp(log_ratio), trial);
    return type_s_squares(body, trial.A.diagonal()).twice_product;
  };
  for (double ratio = 1; ratio > least_ratio; ratio /= factor) {
    const auto root = bracketed_root(product, std::log(ratio), std::log(ratio / factor));
    if (!root) continue;
    if (mechanics::Status status = shaped(std::exp(*root), m); !status) continue;
    m.Lambda.setZero();
    return {};
  }
  return mechanics::Status::failure("no figure with these equatorial axes turns steadily without circulation");
}

}  // namespace pseudorigid::reduced
