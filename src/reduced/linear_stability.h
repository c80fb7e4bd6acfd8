#pragma once
/// Linear stability of a steady motion exp(tω̂) A exp(−tΛ̂) (steady_motion.h) of a body with the potential V and the
/// inertia m̄ Id. The multiplier per m̄ is λ. With Q = exp(tω̂)(A + εH)exp(−tΛ̂), the equation of motion (5.120) of
/// pseudo_rigid_body.h is in first order of ε
///
///   Ḧ + 2(ω̂Ḣ − ḢΛ̂) + (ω̂²H − 2ω̂HΛ̂ + HΛ̂²) + D(∂V)(A)[H]/m̄ + λA⁻ᵀHᵀA⁻ᵀ = δλ A⁻ᵀ,   tr(A⁻¹H) = 0.
///
/// In an orthonormal basis T of the tangent space, H = Ty with 8 coordinates y, or 9 on GL⁺(3). δλ is the variation of
/// λ. The equation for y is
///
///   ÿ + 2Gẏ + Ky = 0,   G = −Gᵀ,   K = Kᵀ                                 (mechanics/equilibria/linear_stability.h).
///
/// The rotations of space and of the reference ball give the invariant space N, which contains
///
///   (H, Ḣ) = (ζ̂A, −(ω×ζ)^A)   and   (Aζ̂, −A(Λ×ζ)^),   ζ ∈ R³.
///
/// Here (…)^ is the matrix of the cross product. The growth rates on N are 0, ±i|ω| and ±i|Λ|, and contain no
/// information on the stability. The remainder is the space of fixed angular momentum J and circulation Z, modulo the
/// rotations that do not change these momenta. This space on SL(3) has the dimension 8 for a generic motion. For a
/// sphere at rest and for a spheroid that rotates about its axis, the dimension is 10, because some combinations of
/// rotations do not move these two bodies. On GL⁺(3), the dimensions are larger by 2.

#include <Eigen/Core>
#include <utility>

#include "mechanics/core/status.h"
#include "mechanics/equilibria/linear_stability.h"
#include "reduced/steady_motion.h"

namespace pseudorigid::reduced {

using mechanics::LinearStability, mechanics::Rate, mechanics::ReducedLinearSystem, mechanics::analyse_stability;

namespace detail {

/// Directions of N, momenta and singular values of the constraint count as 0 if they are less than this fraction of the
/// largest value.
inline constexpr double absent = 1e-8;

inline Eigen::Matrix<double, 9, 1> flat(const Eigen::Matrix3d& H) { return H.reshaped(); }
inline Eigen::Matrix3d unflat(const Eigen::VectorXd& h) { return h.reshaped(3, 3); }

/// Orthonormal basis T of the tangent space at the motion m, one column for each direction. The directions are the H
/// with tr(A⁻¹H) = 0, or all H on GL⁺(3).
Eigen::MatrixXd tangent_space(const SteadyMotion& m, bool incompressible);

/// Directions H and rates Ḣ of the rotations in the basis T. The first three columns are for the rotations of space,
/// and the last three are for those of the reference ball.
mechanics::SymmetryDirections turns(const SteadyMotion& m, const Eigen::MatrixXd& T);

}  // namespace detail

/// The equation of small motions in the coordinates y, H = Ty.
struct SmallMotionEquation {
  Eigen::MatrixXd T, K, G;
};

template <SmoothPotential V>
SmallMotionEquation linearisation(const IsotropicBody<V>& body, const SteadyMotion& m) {
  using detail::flat, detail::unflat;
  const Eigen::MatrixXd T = detail::tangent_space(m, body.incompressible);
  const Eigen::Index n = T.cols();
  const Eigen::Matrix3d w = mechanics::cross_matrix(m.omega), l = mechanics::cross_matrix(m.Lambda),
                        A_inverse_transposed = m.A.inverse().transpose();
  Eigen::MatrixXd K(n, n), G(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const Eigen::Matrix3d H = unflat(T.col(j));
    const Eigen::Matrix3d KH = detail::steady_acceleration(m.omega, m.Lambda, H) + body.second_derivative(m.A, H) +
                               m.lambda * A_inverse_transposed * H.transpose() * A_inverse_transposed;
    K.col(j) = T.transpose() * flat(KH);
    G.col(j) = T.transpose() * flat(w * H - H * l);
  }
  return {T, K, G};
}

/// The linear system for a steady motion on the reduced space, the remainder in the head of this file.
template <SmoothPotential V>
ReducedLinearSystem reduce_linearisation(const IsotropicBody<V>& body, const SteadyMotion& m) {
  SmallMotionEquation of = linearisation(body, m);
  return mechanics::reduce(std::move(of.K), std::move(of.G), detail::turns(m, of.T), detail::absent);
}

/// Sets `result` to the growth rates and the stability of m. Fails if a matrix is not finite, or if the eigenvalues do
/// not converge.
template <SmoothPotential V>
mechanics::Status analyse_stability(const IsotropicBody<V>& body, const SteadyMotion& m, LinearStability& result) {
  return analyse_stability(reduce_linearisation(body, m), result);
}

}  // namespace pseudorigid::reduced
