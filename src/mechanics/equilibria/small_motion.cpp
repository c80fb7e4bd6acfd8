#include "mechanics/equilibria/small_motion.h"

#include <algorithm>
#include <cmath>

#include "mechanics/core/dense_algebra.h"

namespace pseudorigid::mechanics {

Status motion_near(const Eigen::MatrixXd& K, const Eigen::MatrixXd& G, std::complex<double> rate, SmallMotion& motion) {
  using Complex = std::complex<double>;
  const Eigen::Index n = K.rows();
  const double scale = std::max({std::sqrt(K.norm()), G.norm(), std::abs(rate)});
  const auto matrix = [&](Complex s) -> Eigen::MatrixXcd {
    return s * s * Eigen::MatrixXcd::Identity(n, n) + 2.0 * s * G + K;
  };
  Complex& s = motion.rate;
  Eigen::VectorXcd& y = motion.shape;
  s = rate;
  y = Eigen::VectorXcd::Zero(n);
  Eigen::VectorXcd velocity(n);  // the start has parts along all shapes
  for (Eigen::Index i = 0; i < n; ++i) velocity[i] = std::cos(1.0 + static_cast<double>(i));
  // The first iterations have the same shift and find the motion. The others have the last value of s and converge
  // fast.
  constexpr int n_iterations = 6, n_with_first_shift = 3;
  for (int i = 0; i < n_iterations; ++i) {
    const Complex near = s + 1e-10 * scale;  // at the rate itself the matrix is singular
    // An iteration of the first-order system y' = velocity, velocity' = −K y − 2 G velocity.
    const Eigen::VectorXcd next = solve_complex(matrix(near), velocity + 2.0 * (G * y) + near * y);
    velocity = near * next - y;
    y = next;
    const double size = std::max(y.norm(), velocity.norm() / scale);
    y /= size;
    velocity /= size;
    if (i + 1 < n_with_first_shift) continue;
    y.normalize();
    // s is the root of s² + 2s yᴴGy + yᴴKy = 0 that is closer to the last value.
    const Complex half = y.dot(G * y), root = std::sqrt(half * half - y.dot(K * y));
    const Complex one = -half + root, other = -half - root;
    s = std::abs(one - s) < std::abs(other - s) ? one : other;
    velocity = s * y;
  }
  if (G.isZero(0)) {  // the real and the imaginary part of any e^{iα} y have the same rate; the largest real part is y
    const Complex square = y.cwiseProduct(y).sum();
    const Eigen::VectorXd real = (std::polar(1.0, -std::arg(square) / 2) * y).real();
    y = real.normalized().cast<Complex>();
  }
  const double residual = (matrix(s) * y).norm() / (scale * scale);
  constexpr double accepted = 1e-9;
  if (residual <= accepted) return {};
  return Status::failure("the iteration for a small motion ends with a residual of " + six_digits(residual));
}

const std::array<Eigen::Vector3d, 7>& phase_points() {
  static const std::array<Eigen::Vector3d, 7> points = [] {
    std::array<Eigen::Vector3d, 7> made;
    const std::array<std::array<int, 3>, 7> directions{
        {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}}};
    for (std::size_t k = 0; k < made.size(); ++k)
      made[k] = Eigen::Vector3d(directions[k][0], directions[k][1], directions[k][2]).normalized();
    return made;
  }();
  return points;
}

std::complex<double> factor_of_shape(double amplitude, double mean_square, const PhaseDisplacements& displacements) {
  // Components of equal size differ by the errors of the discretisation, so the first of them is chosen.
  constexpr double nearly = 0.9;
  const double enough = nearly * displacements.cwiseAbs().maxCoeff();
  const auto all = displacements.reshaped();
  const auto chosen =
      std::find_if(all.begin(), all.end(), [&](const auto& component) { return std::abs(component) >= enough; });
  const std::complex<double> phase = std::abs(*chosen) > 0 ? std::conj(*chosen) / std::abs(*chosen) : 1.0;
  return amplitude / std::sqrt(mean_square) * phase;
}

}  // namespace pseudorigid::mechanics
