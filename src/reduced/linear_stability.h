#pragma once
/// Linear stability of a steady motion. With Q = exp(tω̂)(A + εH)exp(−tΛ̂), (5.120) is to first order
///
///   Ḧ + 2(ω̂Ḣ − ḢΛ̂) + (ω̂²H − 2ω̂HΛ̂ + HΛ̂²) + D(∂V)(A)[H]/m̄ + λA⁻ᵀHᵀA⁻ᵀ = δλ A⁻ᵀ,   tr(A⁻¹H) = 0.
///
/// In an orthonormal basis T of the tangent space, H = Ty (8 dimensions; on GL⁺(3) 9), this is
///
///   ÿ + 2Gẏ + Ky = 0,   G = −Gᵀ,   K = Kᵀ,
///
/// a linear Hamiltonian system in x = (y, ẏ):  Wẋ = −Sx with the conserved energy ½xᵀSx, S = diag(K, Id), and the
/// symplectic form W = [2G, Id; −Id, 0].
///
/// The turns of space and of the reference ball give the invariant space N of
///
///   (H, Ḣ) = (ζ̂A, −(ω×ζ)^A)   and   (Aζ̂, −A(Λ×ζ)^),   ζ ∈ R³,
///
/// whose rates are known (0, ±i|ω|, ±i|Λ|) and say nothing. What is left is the space of fixed J and Z modulo the group
/// that keeps J and Z (Marsden–Weinstein),
///
///   N^W / (N ∩ N^W),   N^W = {x: nᵀWx = 0 for n in N} = ker dJ ∩ ker dZ,
///
/// on which S and W are again well defined: no double zero of a symmetry is left that round-off would split. Its
/// dimension is 8 for a generic motion, 10 for a spheroid turning about its axis (the symmetry about it is then no
/// motion of the figure) and for a sphere at rest.
///
/// Time is scaled by the largest frequency of K and G, so that all thresholds are relative.

#include <Eigen/Core>
#include <complex>
#include <utility>
#include <vector>

#include "mechanics/core/status.h"
#include "reduced/steady_motion.h"

namespace pseudorigid::reduced {

/// The linear system on the reduced space, in the scaled time: x' = −W⁻¹S x, d/dt = scale · d/dt'.
struct ReducedLinearSystem {
  Eigen::MatrixXd S, W;
  double scale = 1;
};

/// A rate s of the motion, δQ ~ exp(st), and the sign of its energy ½x̄ᵀSx: −1, 0, +1 (0 off the imaginary axis).
struct Rate {
  std::complex<double> s;
  int energy_sign = 0;
};

struct LinearStability {
  std::vector<Rate> rates;
  Eigen::VectorXd second_variation;  ///< eigenvalues of S, rising: of the energy at fixed J and Z
  int n_negative = 0;                ///< how many of them are negative; 0 and none zero: stable (Dirichlet's criterion)
  double growth_rate = 0;            ///< largest real part, 0 where it is round-off
  bool stable = true;                ///< spectrally: no rate with positive real part
};

namespace detail {

/// Real parts below this part of the largest rate count as zero: colliding rates are split by √ε, times a condition.
inline constexpr double zero_growth = 1e-6;
/// Eigenvalues of the second variation (of order 1) below this count as zero.
inline constexpr double zero_variation = 1e-12;
/// Directions of N, and of J and Z, below this part of the largest count as absent.
inline constexpr double absent = 1e-8;

inline Eigen::Matrix<double, 9, 1> flat(const Eigen::Matrix3d& H) { return H.reshaped(); }
inline Eigen::Matrix3d unflat(const Eigen::VectorXd& h) { return h.reshaped(3, 3); }

/// T: orthonormal basis of the tangent space.
Eigen::MatrixXd tangent_space(const SteadyMotion& m, bool incompressible);

/// S and W on N^W / (N ∩ N^W), represented on the orthogonal complement of N ∩ N^W in N^W, from K and G in the basis T.
ReducedLinearSystem reduce(const SteadyMotion& m, const Eigen::MatrixXd& T, Eigen::MatrixXd K, Eigen::MatrixXd G);

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
  return detail::reduce(m, T, std::move(K), std::move(G));
}

/// Rates, second variation and stability. Fails where the system, that is the second derivative, is not finite.
mechanics::Status analyse_stability(const ReducedLinearSystem& system, LinearStability& result);

template <SmoothPotential V>
mechanics::Status analyse_stability(const IsotropicBody<V>& body, const SteadyMotion& m, LinearStability& result) {
  return analyse_stability(reduce_linearisation(body, m), result);
}

}  // namespace pseudorigid::reduced
