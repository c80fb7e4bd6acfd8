#pragma once
/// Steady motions as zeros of a function of eight numbers. A steady motion has the deformation A, the angular velocity
/// ω, the internal rotation Λ and the multiplier λ per m̄, with the inertia E₀ = m̄ Id (steady_motion.h). By Riemann's
/// theorem (ellipsoidal_motions.h), rotations can make A diagonal in every steady motion, with ω and Λ in the plane of
/// axes 2 and 3. With A = diag(a) and the residual R of the equation of motion, the unknowns u and the function F are
///
///   u = (ln a₁, ln a₂, ln a₃, ω₂, ω₃, Λ₂, Λ₃, λ),
///   F = ((RA)₁₁, (RA)₂₂, (RA)₃₃, (RA)₂₃, (RA)₃₂, ln a₁a₂a₃)      (on GL⁺(3): λ in the last place).
///
/// The other entries of R vanish for an isotropic potential. The derivatives of these six equations are exact. There
/// are eight unknowns, so the motions form a surface. Two further equations, the values of two quantities (axis ratios,
/// spin, momenta, …), select one motion.

#include <array>
#include <limits>
#include <string>

#include "mechanics/core/automatic_differentiation.h"
#include "mechanics/core/status.h"
#include "reduced/steady_motion.h"

namespace pseudorigid::reduced {

using PlaneVector = Eigen::Matrix<double, 8, 1>;
using PlaneMatrix = Eigen::Matrix<double, 8, 8>;

/// `plane_coordinates` returns the coordinates u of a motion with diagonal A > 0 and with ω and Λ in the plane of axes
/// 2 and 3. `motion_of` is the inverse map.
inline PlaneVector plane_coordinates(const SteadyMotion& m) {
  PlaneVector u;
  u << m.A.diagonal().array().log().matrix(), m.omega.tail<2>(), m.Lambda.tail<2>(), m.lambda;
  return u;
}
inline SteadyMotion motion_of(const PlaneVector& u) {
  SteadyMotion m;
  m.A = Eigen::Vector3d(u.head<3>().array().exp()).asDiagonal();
  m.omega << 0, u.segment<2>(3);
  m.Lambda << 0, u.segment<2>(5);
  m.lambda = u[7];
  return m;
}

/// Rotates the motion such that A = diag(a) with a > 0, and permutes the axes such that ω₁² + Λ₁² is least. A motion
/// with such A and ω₁ = Λ₁ = 0 is not changed. Requires det A > 0.
SteadyMotion to_principal_plane(const SteadyMotion& m);

/// A quantity of the motion as a function of u. PlaneDual is a number with its derivatives with respect to the eight
/// entries of u.
using PlaneDual = mechanics::Dual<double, 8>;
using PlaneDuals = mechanics::Coordinates<PlaneDual, 8>;
using Quantity = PlaneDual (*)(const PlaneDuals&);

namespace quantities {
inline PlaneDual axis_ratio_21(const PlaneDuals& u) { return exp(u[1] - u[0]); }
inline PlaneDual axis_ratio_31(const PlaneDuals& u) { return exp(u[2] - u[0]); }
/// The eccentricity e = √(1 − a₃²/a₁²), which is not differentiable at the sphere and is NaN if a₃ > a₁.
inline PlaneDual eccentricity(const PlaneDuals& u) { return sqrt(1.0 - exp(2.0 * (u[2] - u[0]))); }
inline PlaneDual omega_2(const PlaneDuals& u) { return u[3]; }
inline PlaneDual omega_3(const PlaneDuals& u) { return u[4]; }
inline PlaneDual Lambda_2(const PlaneDuals& u) { return u[5]; }
inline PlaneDual Lambda_3(const PlaneDuals& u) { return u[6]; }
/// The angular momentum about axis 3 divided by m̄, J₃/m̄ = (a₁² + a₂²)ω₃ − 2a₁a₂Λ₃.
inline PlaneDual angular_momentum_3(const PlaneDuals& u) {
  const PlaneDual a1 = exp(u[0]), a2 = exp(u[1]);
  return (a1 * a1 + a2 * a2) * u[4] - 2.0 * a1 * a2 * u[6];
}
/// The circulation about axis 3 divided by m̄, Z₃/m̄ = 2a₁a₂ω₃ − (a₁² + a₂²)Λ₃.
inline PlaneDual circulation_3(const PlaneDuals& u) {
  const PlaneDual a1 = exp(u[0]), a2 = exp(u[1]);
  return 2.0 * a1 * a2 * u[4] - (a1 * a1 + a2 * a2) * u[6];
}
}  // namespace quantities

inline double value_of(Quantity q, const PlaneVector& u) { return q(mechanics::independent<double, 8>(u)).value(); }

/// Sets rows 0–5 of F to the six equations in the head of this file, and rows 0–5 of DF to their derivatives with
/// respect to u.
template <SmoothPotential V>
void steady_equations(const IsotropicBody<V>& body, const PlaneVector& u, PlaneVector& F, PlaneMatrix& DF) {
  const SteadyMotion m = motion_of(u);
  const Eigen::Matrix3d &A = m.A, R = steady_residual(body, m), w = mechanics::cross_matrix(m.omega),
                        l = mechanics::cross_matrix(m.Lambda), A_inverse = A.inverse();
  const auto rows = [](const Eigen::Matrix3d& X, double last) {
    return Eigen::Matrix<double, 6, 1>(X(0, 0), X(1, 1), X(2, 2), X(1, 2), X(2, 1), last);
  };
  F.head<6>() = rows(R * A, body.incompressible ? u.head<3>().sum() : u[7]);
  for (int i = 0; i < 3; ++i) {
    Eigen::Matrix3d H = Eigen::Matrix3d::Zero();  // the derivative ∂A/∂ln a_i
    H(i, i) = A(i, i);
    const Eigen::Matrix3d dR = detail::steady_acceleration(m.omega, m.Lambda, H) + body.second_derivative(A, H) +
                               m.lambda * A_inverse * H * A_inverse;
    DF.col(i).head<6>() = rows(dR * A + R * H, body.incompressible);
  }
  for (int i = 1; i < 3; ++i) {
    const Eigen::Matrix3d e = mechanics::cross_matrix(Eigen::Vector3d::Unit(i));
    DF.col(2 + i).head<6>() = rows(((e * w + w * e) * A - 2 * e * A * l) * A, 0);  // derivatives by ω_i
    DF.col(4 + i).head<6>() = rows((A * (e * l + l * e) - 2 * w * A * e) * A, 0);  // derivatives by Λ_i
  }
  DF.col(7).head<6>() = rows(-Eigen::Matrix3d::Identity(), !body.incompressible);
}

namespace detail {

/// Newton's step DF⁻¹F by the singular value decomposition of DF. Components of F along left singular vectors are set
/// to 0 if they are at round-off. At a bifurcation, these components would be divided by a singular value near 0 and
/// would lead to another branch.
PlaneVector newton_step(const PlaneMatrix& DF, const PlaneVector& F, double round_off);

/// Newton's iteration for F = 0. equations(u, F, DF) sets F and its derivative DF. The iteration ends if |F| is small
/// and no longer halves, if a step is 0, if a number is not finite, or after 60 steps. Then u is set to the iterate
/// with the least |F|. The function fails if this |F| is larger than the round-off of terms of size `scale`. The length
/// of a step is limited, so that the axes cannot overflow.
template <class Equations>
mechanics::Status plane_newton(const Equations& equations, double scale, PlaneVector& u) {
  constexpr int max_iterations = 60;
  constexpr double longest_step = 0.4, accepted = 1e-12, round_off = 1e-15;
  PlaneVector F, best_u = u;
  PlaneMatrix DF;
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < max_iterations; ++i) {
    equations(u, F, DF);
    const double size = F.template lpNorm<Eigen::Infinity>();
    if (!std::isfinite(size) || !DF.allFinite()) break;
    if (size >= 0.5 * best && best <= accepted * scale) break;
    if (size < best) best = size, best_u = u;
    const PlaneVector step = newton_step(DF, F, round_off * scale);
    const double length = step.template lpNorm<Eigen::Infinity>();
    if (length == 0 || !std::isfinite(length)) break;
    u -= step * std::min(1.0, longest_step / length);
  }
  u = best_u;
  if (best <= accepted * scale) return {};
  return mechanics::Status::failure("Newton's iteration finds no steady motion here; it ends with a residual of " +
                                    mechanics::six_digits(best / scale) + " of the terms");
}

/// Size of the terms of F, with which |F| is compared.
template <SmoothPotential V>
double equations_scale(const IsotropicBody<V>& body, const PlaneVector& u) {
  const SteadyMotion m = motion_of(u);
  return 1 + steady_residual_scale(body, m) * m.A.norm();
}

}  // namespace detail

/// A condition on a motion: the quantity has this value.
struct Target {
  Quantity quantity;
  double value;
};

/// Replaces `motion` by a steady motion near it with the two values of `targets`. Fails if det A is not positive or if
/// Newton's iteration does not converge; `motion` then does not change. At a fold or a bifurcation, the two values may
/// not determine one motion. The iteration then fails or finds a neighbouring motion.
template <SmoothPotential V>
mechanics::Status find_steady_motion(const IsotropicBody<V>& body, const std::array<Target, 2>& targets,
                                     SteadyMotion& motion) {
  if (!(motion.A.determinant() > 0)) return mechanics::Status::failure("det A of a steady motion must be positive");
  PlaneVector u = plane_coordinates(to_principal_plane(motion));
  const auto equations = [&](const PlaneVector& x, PlaneVector& F, PlaneMatrix& DF) {
    steady_equations(body, x, F, DF);
    for (int k = 0; k < 2; ++k) {
      const PlaneDual q = targets[k].quantity(mechanics::independent<double, 8>(x));
      F[6 + k] = q.value() - targets[k].value;
      DF.row(6 + k) = q.derivatives().transpose();
    }
  };
  mechanics::Status status = detail::plane_newton(equations, detail::equations_scale(body, u), u);
  if (status) motion = motion_of(u);
  return status;
}

}  // namespace pseudorigid::reduced
