#include "observables/vibration.h"

#include <Eigen/Dense>
#include <utility>

#include "mechanics/core/axial_vectors.h"
#include "mechanics/core/dense_algebra.h"
#include "mechanics/core/principal_axes.h"
#include "mechanics/core/solid_harmonics.h"
#include "observables/whole_body.h"

namespace pseudorigid::mechanics {
namespace {

constexpr int n_functions = SpheroidalMotions::n_powers;
constexpr Eigen::Index n_scalars = 1 + 9 + 9;  // kinetic energy, ∫ρ x xᵀ, ∫ρ x vᵀ; in sums(), the products follow

}  // namespace

/// Computes the modes by Ritz's method with f = r^{n + 2j}, j = 0 … 4, for a ball of radius, density and shear modulus
/// 1. With f = r^{p + 1}, a motion has the radial part U Y and the tangential part V r∇Y. Here U = N r^p, V = (p + 2)
/// r^p and N = n(n + 1). For small strains, its elastic energy is ½∫₀¹ k dr. With the derivatives U' and V' by r, k is
///
///   2 U'² r² + N (r V' − V + U)² + 2N(N − 1) V² − 4N U V + 4U².
SpheroidalModes::SpheroidalModes(int n) {
  const double N = n * (n + 1);
  Eigen::MatrixXd M(n_functions, n_functions), K = M;
  for (int i = 0; i < n_functions; ++i)
    for (int j = 0; j < n_functions; ++j) {
      const double p = n - 1 + 2 * i, q = n - 1 + 2 * j, U = N, V = p + 2, W = q + 2;
      M(i, j) = (U * U + N * V * W) / (p + q + 3);
      K(i, j) = (2 * p * q * U * U + N * ((p - 1) * V + U) * ((q - 1) * W + U) + 2 * N * (N - 1) * V * W -
                 2 * N * U * (V + W) + 4 * U * U) /
                (p + q + 1);
    }
  const SymmetricSpectrum masses = symmetric_spectrum(M);
  const Eigen::MatrixXd orthonormal = masses.vectors * masses.values.cwiseSqrt().cwiseInverse().asDiagonal();
  const SymmetricSpectrum modes = symmetric_spectrum(orthonormal.transpose() * K * orthonormal);
  omega_squared = modes.values;
  coefficients = orthonormal * modes.vectors;
}

SpheroidalMotions::SpheroidalMotions(const std::array<bool, 3>& reflect) : reflect_(reflect) {
  for (int n = VibrationObservables::first_degree; n <= VibrationObservables::last_degree; ++n)
    for (int m = -n; m <= n; ++m) {
      const auto odd = is_odd(n, m);
      if (!(odd[0] && reflect[0]) && !(odd[1] && reflect[1]) && !(odd[2] && reflect[2])) harmonics_.push_back({n, m});
    }
}

std::vector<int> SpheroidalMotions::degrees() const {
  std::vector<int> degrees;
  for (const Harmonic& harmonic : harmonics_) degrees.push_back(harmonic.n);
  return degrees;
}

/// The row of the motion with f = r^{n + 2j} is (n + 1 + 2j) r^{2j} ∇S − 2nj r^{2j−2} S X, with the solid harmonic
/// S = r^n Y_nm.
Eigen::MatrixX3d SpheroidalMotions::at(const Eigen::Vector3d& X) const {
  const auto solid = solid_harmonics(VibrationObservables::last_degree, {X[0], X[1], X[2]});
  Eigen::MatrixX3d values(size(), 3);
  Eigen::Index row = 0;
  for (const auto& [n, m] : harmonics_) {
    const Jet& S = solid[n][n + m];
    const Eigen::RowVector3d gradient = Eigen::RowVector3d(S.gradient.data()), radial = S.value * X.transpose();
    double power = 1, power_below = 0;  // powers r^{2j} and r^{2j−2}
    for (int j = 0; j < n_powers; ++j) {
      values.row(row++) = (n + 1 + 2 * j) * power * gradient - 2 * n * j * power_below * radial;
      power_below = power;
      power *= X.squaredNorm();
    }
  }
  return values;
}

Vibration::Vibration(const SpheroidalMotions& motions, Eigen::Matrix3Xd X, Eigen::VectorXd masses,
                     Eigen::MatrixXd products)
    : reflect_(motions.reflect()),
      degrees_(motions.degrees()),
      X_(std::move(X)),
      masses_(std::move(masses)),
      products_(std::move(products)) {
  for (const bool is_plane : reflect_)
    if (is_plane) {
      masses_ *= 2;
      products_ *= 2;
    }
  for (int n = VibrationObservables::first_degree; n <= VibrationObservables::last_degree; ++n) modes_.emplace_back(n);
}

Eigen::VectorXd Vibration::sums(const Eigen::Matrix3Xd& x, const Eigen::Matrix3Xd& v, const Eigen::Matrix3d& Q,
                                const Eigen::Matrix3d& Qdot) const {
  const PrincipalAxes axes = principal_axes(Q);
  const Eigen::Matrix3d R = axes.U * axes.a.cwiseInverse().asDiagonal() * axes.A;
  // Let Ṙ = RΩ with Ω = cross_matrix(ω). Since S is symmetric, ΩS + SΩ = RᵀQ̇ − Q̇ᵀR. The left-hand side is
  // cross_matrix((tr S Id − S)ω).
  const Eigen::Matrix3d S = R.transpose() * Q;
  const Eigen::Vector3d twice = -axial_vector(R.transpose() * Qdot);
  const Eigen::Vector3d omega = (S.trace() * Eigen::Matrix3d::Identity() - S).inverse() * twice;
  const Eigen::Matrix3Xd turned = R.transpose() * x, u = turned - X_;
  const Eigen::Matrix3Xd rate = R.transpose() * v - cross_matrix(omega) * turned;

  const Eigen::Index n_products = products_.rows();
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(n_scalars + 2 * n_products);
  sums[0] = 0.5 * v.colwise().squaredNorm().dot(masses_);
  const Eigen::Matrix3Xd weighted = x * masses_.asDiagonal();
  sums.segment<9>(1).reshaped(3, 3) = without_odd_entries(weighted * x.transpose(), reflect_);
  sums.segment<9>(10).reshaped(3, 3) = without_odd_entries(weighted * v.transpose(), reflect_);
  sums.segment(n_scalars, n_products) = products_ * u.reshaped();
  sums.tail(n_products) = products_ * rate.reshaped();
  return sums;
}

VibrationObservables Vibration::observables(const Eigen::VectorXd& sums, double elastic) const {
  const Eigen::Matrix3d moment = sums.segment<9>(1).reshaped(3, 3);
  const Eigen::Vector3d J = axial_vector(sums.segment<9>(10).reshaped(3, 3));
  const Eigen::Matrix3d inertia = moment.trace() * Eigen::Matrix3d::Identity() - moment;
  VibrationObservables result;
  result.energy = sums[0] - 0.5 * J.dot(inertia.inverse() * J) + elastic;
  result.of_degree.fill(0);
  for (std::size_t h = 0; h < degrees_.size(); ++h) {
    const std::size_t degree = degrees_[h] - VibrationObservables::first_degree;
    const Eigen::Index at = n_scalars + static_cast<Eigen::Index>(h) * n_functions;
    const auto of_modes = [&](Eigen::Index first) {
      return (modes_[degree].coefficients.transpose() * sums.segment(first, n_functions)).array().square().eval();
    };
    result.of_degree[degree] +=
        0.5 * (of_modes(at + products_.rows()) + modes_[degree].omega_squared.array() * of_modes(at)).sum();
  }
  return result;
}

}  // namespace pseudorigid::mechanics
