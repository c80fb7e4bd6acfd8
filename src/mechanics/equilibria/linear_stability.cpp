#include "mechanics/equilibria/linear_stability.h"

#include <algorithm>
#include <cmath>

#include "mechanics/core/dense_algebra.h"

namespace pseudorigid::mechanics {
namespace {

/// Returns an orthonormal basis of the space N of the symmetry directions (y, ẏ), with ẏ in scaled time. The directions
/// are normalised first. Otherwise the rotation of a thin body about its long axis could count as zero, because its
/// displacements are small.
Eigen::MatrixXd basis_of(const SymmetryDirections& symmetries, double scale, double absent) {
  const Eigen::Index n = symmetries.y.rows();
  Eigen::MatrixXd N(2 * n, symmetries.y.cols());
  N.topRows(n) = symmetries.y;
  N.bottomRows(n) = symmetries.rate / scale;
  return span_of(N.colwise().normalized(), absent);
}

}  // namespace

ReducedLinearSystem reduce(Eigen::MatrixXd K, Eigen::MatrixXd G, const SymmetryDirections& symmetries, double absent) {
  const Eigen::Index n = K.rows();
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
  if (symmetries.y.cols() == 0) {
    reduced.S = S;
    reduced.W = W;
    return reduced;
  }

  const Eigen::MatrixXd N = basis_of(symmetries, reduced.scale, absent);
  const Eigen::MatrixXd NW = N.transpose() * W, NWN = NW * N;
  // Basis of N ∩ N^W, the vectors x in N with nᵀWx = 0 for all n in N. If W vanishes on N, as for zero momenta, N ∩ N^W
  // is N.
  const Eigen::MatrixXd both = NWN.norm() > absent ? Eigen::MatrixXd(N * null_space(NWN, absent)) : N;
  Eigen::MatrixXd conditions(N.cols() + both.cols(), 2 * n);
  conditions.topRows(N.cols()) = NW;
  conditions.bottomRows(both.cols()) = both.transpose();
  const Eigen::MatrixXd D = null_space(conditions, absent);
  reduced.S = D.transpose() * S * D;
  reduced.W = D.transpose() * W * D;
  return reduced;
}

Status analyse_stability(const ReducedLinearSystem& system, LinearStability& result) {
  if (!system.S.allFinite() || !system.W.allFinite())
    return Status::failure("the linearisation about the steady motion is not finite");
  const Eigen::MatrixXd S = (system.S + system.S.transpose()) / 2;
  result = {};
  if (S.size() == 0) return {};
  result.second_variation = symmetric_spectrum(S).values;
  result.n_negative = static_cast<int>((result.second_variation.array() < -zero_variation).count());

  const Spectrum found = spectrum(solve(system.W, -S));
  if (!found.converged) return Status::failure("the eigenvalues of the linearised steady motion do not converge");
  const Eigen::MatrixXcd& X = found.vectors;
  for (Eigen::Index k = 0; k < X.cols(); ++k) {
    const double energy = X.col(k).dot(S * X.col(k)).real() / X.col(k).squaredNorm();
    const int sign = std::abs(energy) < zero_growth ? 0 : energy > 0 ? 1 : -1;
    result.rates.push_back({system.scale * found.values[k], sign});
  }
  std::sort(result.rates.begin(), result.rates.end(), [](const Rate& a, const Rate& b) {
    return a.s.imag() != b.s.imag() ? a.s.imag() < b.s.imag() : a.s.real() < b.s.real();
  });
  const double largest = system.scale * found.values.cwiseAbs().maxCoeff(),
               growth = system.scale * found.values.real().maxCoeff();
  result.stable = growth <= zero_growth * largest;
  result.growth_rate = result.stable ? 0 : growth;
  return {};
}

}  // namespace pseudorigid::mechanics
