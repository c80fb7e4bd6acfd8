#include "reduced/linear_stability.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "mechanics/core/dense_algebra.h"

namespace pseudorigid::reduced {
namespace detail {

using mechanics::null_space;

namespace {

/// The turns (H, Ḣ) at ζ = e_k, in scaled time, of length 1: turns about the axis of a needle move little.
Eigen::MatrixXd symmetry_directions(const SteadyMotion& m, const Eigen::MatrixXd& T, double scale) {
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

}  // namespace

Eigen::MatrixXd tangent_space(const SteadyMotion& m, bool incompressible) {
  if (!incompressible) return Eigen::MatrixXd::Identity(9, 9);
  return null_space(flat(m.A.inverse().transpose()).transpose(), absent);
}

ReducedLinearSystem reduce(const SteadyMotion& m, const Eigen::MatrixXd& T, Eigen::MatrixXd K, Eigen::MatrixXd G) {
  const Eigen::Index n = T.cols();
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

  const Eigen::MatrixXd N = mechanics::span_of(symmetry_directions(m, T, reduced.scale), absent);
  const Eigen::MatrixXd NW = N.transpose() * W, NWN = NW * N;
  // N ∩ N^W: with J = Z = 0 all of N.
  const Eigen::MatrixXd both = NWN.norm() > absent ? Eigen::MatrixXd(N * null_space(NWN, absent)) : N;
  Eigen::MatrixXd conditions(N.cols() + both.cols(), 2 * n);
  conditions << NW, both.transpose();
  const Eigen::MatrixXd D = null_space(conditions, absent);
  reduced.S = D.transpose() * S * D;
  reduced.W = D.transpose() * W * D;
  return reduced;
}

}  // namespace detail

mechanics::Status analyse_stability(const ReducedLinearSystem& system, LinearStability& result) {
  if (!system.S.allFinite() || !system.W.allFinite())
    return mechanics::Status::failure("the linearisation about the steady motion is not finite");
  const Eigen::MatrixXd S = (system.S + system.S.transpose()) / 2;
  result = {};
  result.second_variation = mechanics::symmetric_spectrum(S).values;
  result.n_negative = static_cast<int>((result.second_variation.array() < -detail::zero_variation).count());

  const mechanics::Spectrum spectrum = mechanics::spectrum(mechanics::solve(system.W, -S));
  if (!spectrum.converged)
    return mechanics::Status::failure("the eigenvalues of the linearised steady motion do not converge");
  const Eigen::MatrixXcd& X = spectrum.vectors;
  for (Eigen::Index k = 0; k < X.cols(); ++k) {
    const double energy = X.col(k).dot(S * X.col(k)).real() / X.col(k).squaredNorm();
    const int sign = std::abs(energy) < detail::zero_growth ? 0 : energy > 0 ? 1 : -1;
    result.rates.push_back({system.scale * spectrum.values[k], sign});
  }
  std::sort(result.rates.begin(), result.rates.end(), [](const Rate& a, const Rate& b) {
    return a.s.imag() != b.s.imag() ? a.s.imag() < b.s.imag() : a.s.real() < b.s.real();
  });
  const double largest = system.scale * spectrum.values.cwiseAbs().maxCoeff(),
               growth = system.scale * spectrum.values.real().maxCoeff();
  result.stable = growth <= detail::zero_growth * largest;
  result.growth_rate = result.stable ? 0 : growth;
  return {};
}

}  // namespace pseudorigid::reduced
