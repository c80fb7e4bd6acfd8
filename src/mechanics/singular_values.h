#pragma once
/// Singular values of a 3×3 matrix by one-sided Jacobi rotations (Hestenes; Demmel, Veselić 1992): columns are rotated
/// in pairs until they are orthogonal; their lengths are the singular values. Small ones keep their relative accuracy,
/// which the eigenvalues of QQᵀ would lose.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>

namespace pseudorigid::mechanics {

/// σ₁ ≥ σ₂ ≥ σ₃ of Q. A matrix that is not finite gives values that are not finite.
inline Eigen::Vector3d singular_values(Eigen::Matrix3d Q) {
  constexpr int max_sweeps = 12;  // convergence is quadratic; five are the rule
  for (int sweep = 0; sweep < max_sweeps; ++sweep) {
    bool rotated = false;
    for (const auto& [i, j] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
      const double a = Q.col(i).squaredNorm(), b = Q.col(j).squaredNorm(), c = Q.col(i).dot(Q.col(j));
      if (!(std::abs(c) > 1e-16 * std::sqrt(a) * std::sqrt(b))) continue;
      rotated = true;
      const double zeta = (b - a) / (2 * c);
      const double t = std::copysign(1.0, zeta) / (std::abs(zeta) + std::hypot(1.0, zeta));
      const double cosine = 1 / std::hypot(1.0, t), sine = cosine * t;
      const Eigen::Vector3d old = Q.col(i);
      Q.col(i) = cosine * old - sine * Q.col(j);
      Q.col(j) = sine * old + cosine * Q.col(j);
    }
    if (!rotated) break;
  }
  Eigen::Vector3d sigma(Q.col(0).norm(), Q.col(1).norm(), Q.col(2).norm());
  std::sort(sigma.begin(), sigma.end(), std::greater<>());
  return sigma;
}

}  // namespace pseudorigid::mechanics
