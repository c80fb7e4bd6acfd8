#pragma once
/// Linear stability of a steady motion. With Q = exp(tω̂)(A + εH)exp(−tΛ̂), (5.120) is to first order
///
///   Ḧ + 2(ω̂Ḣ − ḢΛ̂) + (ω̂²H − 2ω̂HΛ̂ + HΛ̂²) + D(∂V)(A)[H]/m̄ + λA⁻ᵀHᵀA⁻ᵀ = δλ A⁻ᵀ,   tr(A⁻¹H) = 0.
///
/// In an orthonormal basis T of the tangent space, H = Ty (8 dimensions; on GL⁺(3) 9), this is
///
///   ÿ + 2Gẏ + Ky = 0,   G = −Gᵀ,   K = Kᵀ                                 (mechanics/equilibria/linear_stability.h).
///
/// The turns of space and of the reference ball give the invariant space N of
///
///   (H, Ḣ) = (ζ̂A, −(ω×ζ)^A)   and   (Aζ̂, −A(Λ×ζ)^),   ζ ∈ R³,
///
/// whose rates are known (0, ±i|ω|, ±i|Λ|) and say nothing. What is left is the space of fixed J and Z modulo the group
/// that keeps J and Z; its dimension is 8 for a generic motion, 10 for a spheroid turning about its axis (the symmetry
/// about it is then no motion of the figure) and for a sphere at rest.

#include <Eigen/Core>
#include <utility>

#include "mechanics/core/status.h"
#include "mechanics/equilibria/linear_stability.h"
#include "reduced/steady_motion.h"

namespace pseudorigid::reduced {

using mechanics::LinearStability, mechanics::Rate, mechanics::ReducedLinearSystem, mechanics::analyse_stability;

namespace detail {

/// Directions of N, and of J and Z, below this part of the largest count as absent.
inline constexpr double absent = 1e-8;

inline Eigen::Matrix<double, 9, 1> flat(const Eigen::Matrix3d& H) { return H.reshaped(); }
inline Eigen::Matrix3d unflat(const Eigen::VectorXd& h) { return h.reshaped(3, 3); }

/// T: orthonormal basis of the tangent space.
Eigen::MatrixXd tangent_space(const SteadyMotion& m, bool incompressible);

/// The rotations in the basis T.
mechanics::SymmetryDirections turns(const SteadyMotion& m, const Eigen::MatrixXd& T);

}  // namespace detail

/// S and W about a steady motion.
template <SmoothPotential V>
ReducedLinearSystem reduce_linearisation(const IsotropicBody<V>& body, const SteadyMotion& m) {
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
  return mechanics::reduce(std::move(K), std::move(G), detail::turns(m, T), detail::absent);
}

template <SmoothPotential V>
mechanics::Status analyse_stability(const IsotropicBody<V>& body, const SteadyMotion& m, LinearStability& result) {
  return analyse_stability(reduce_linearisation(body, m), result);
}

}  // namespace pseudorigid::reduced
