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

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "mechanics/status.h"
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

/// Orthonormal basis of {x: Bx = 0}.
inline Eigen::MatrixXd null_space(const Eigen::MatrixXd& B) {
  if (B.rows() == 0) return Eigen::MatrixXd::Identity(B.cols(), B.cols());
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(B, Eigen::ComputeFullV);
  const Eigen::Index rank = (svd.singularValues().array() > absent * svd.singularValues()[0]).count();
  return svd.matrixV().rightCols(B.cols() - rank);
}

/// T: orthonormal basis of the tangent space.
inline Eigen::MatrixXd tangent_space(const SteadyMotion& m, bool incompressible) {
  if (!incompressible) return Eigen::MatrixXd::Identity(9, 9);
  return null_space(flat(m.A.inverse().transpose()).transpose());
}

/// The turns (H, Ḣ) at ζ = e_k, in scaled time, of length 1: turns about the axis of a needle move little.
inline Eigen::MatrixXd symmetry_directions(const SteadyMotion& m, const Eigen::MatrixXd& T, double scale) {
  const Eigen::Index n = T.cols();
  Eigen::MatrixXd N(2 * n, 6);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d zeta = Eigen::Vector3d::Unit(k);
    const auto hat = [](const Eigen::Vector3d& w) { return mechanics::cross_matrix(w); };
    N.col(k) << T.transpose() * flat(hat(zeta) * m.A), T.transpose() * flat(-hat(m.omega.cross(zeta)) * m.A) / scale;
    N.col(3 + k) << T.transpose() * flat(m.A * hat(zeta)),
        T.transpose() * flat(-m.A * hat(m.Lambda.cross(zeta))) / scale;
  }
  return N.colwise().normalized();
}

/// Orthonormal basis of the span.
inline Eigen::MatrixXd span(const Eigen::MatrixXd& N) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(N, Eigen::ComputeThinU);
  const Eigen::Index rank = (svd.singularValues().array() > absent * svd.singularValues()[0]).count();
  return svd.matrixU().leftCols(rank);
}

}  // namespace detail

/// S and W on N^W / (N ∩ N^W), represented on the orthogonal complement of N ∩ N^W in N^W.
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
  ReducedLinearSystem reduced;
  reduced.scale = std::sqrt(std::max(K.norm(), G.squaredNorm()));
  if (!(reduced.scale > 0)) reduced.scale = 1;
  K = (K + K.transpose()).eval() / (2 * reduced.scale * reduced.scale);
  G /= reduced.scale;

  Eigen::MatrixXd S = Eigen::MatrixXd::Identity(2 * n, 2 * n), W = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  S.topLeftCorner(n, n) = K;
  W.topLeftCorner(n, n) = 2 * G;
  W.topRightCorner(n, n).setIdentity();
  W.bottomLeftCorner(n, n) = -Eigen::MatrixXd::Identity(n, n);

  const Eigen::MatrixXd N = detail::span(detail::symmetry_directions(m, T, reduced.scale));
  const Eigen::MatrixXd NW = N.transpose() * W, NWN = NW * N;
  // N ∩ N^W: with J = Z = 0 all of N.
  const Eigen::MatrixXd both = NWN.norm() > detail::absent ? Eigen::MatrixXd(N * detail::null_space(NWN)) : N;
  Eigen::MatrixXd conditions(N.cols() + both.cols(), 2 * n);
  conditions << NW, both.transpose();
  const Eigen::MatrixXd D = detail::null_space(conditions);
  reduced.S = D.transpose() * S * D;
  reduced.W = D.transpose() * W * D;
  return reduced;
}

/// Rates, second variation and stability of a steady motion. Fails where the second derivative is not finite.
template <SmoothPotential V>
mechanics::Status analyse_stability(const IsotropicBody<V>& body, const SteadyMotion& m, LinearStability& result) {
  const ReducedLinearSystem system = reduce_linearisation(body, m);
  if (!system.S.allFinite() || !system.W.allFinite())
    return mechanics::Status::failure("the linearisation about the steady motion is not finite");
  const Eigen::MatrixXd S = (system.S + system.S.transpose()) / 2;
  result = {};
  result.second_variation = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(S, Eigen::EigenvaluesOnly).eigenvalues();
  result.n_negative = static_cast<int>((result.second_variation.array() < -detail::zero_variation).count());

  const Eigen::EigenSolver<Eigen::MatrixXd> spectrum(system.W.fullPivLu().solve(-S));
  if (spectrum.info() != Eigen::Success)
    return mechanics::Status::failure("the eigenvalues of the linearised steady motion do not converge");
  const Eigen::MatrixXcd X = spectrum.eigenvectors();
  for (Eigen::Index k = 0; k < X.cols(); ++k) {
    const double energy = X.col(k).dot(S * X.col(k)).real() / X.col(k).squaredNorm();
    const int sign = std::abs(energy) < detail::zero_growth ? 0 : energy > 0 ? 1 : -1;
    result.rates.push_back({system.scale * spectrum.eigenvalues()[k], sign});
  }
  std::sort(result.rates.begin(), result.rates.end(), [](const Rate& a, const Rate& b) {
    return a.s.imag() != b.s.imag() ? a.s.imag() < b.s.imag() : a.s.real() < b.s.real();
  });
  const double largest = system.scale * spectrum.eigenvalues().cwiseAbs().maxCoeff(),
               growth = system.scale * spectrum.eigenvalues().real().maxCoeff();
  result.stable = growth <= detail::zero_growth * largest;
  result.growth_rate = result.stable ? 0 : growth;
  return {};
}

}  // namespace pseudorigid::reduced
