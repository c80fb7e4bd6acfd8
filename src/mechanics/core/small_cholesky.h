#pragma once
/// The factorisation g = LLᵀ of a symmetric, positive definite matrix with a few rows. The solution x = g⁻¹b follows
/// from Ly = b and Lᵀx = y. With the pivots d_j,
///
///   d_j = g_jj − Σ_{k<j} L_jk²,   L_jj = √d_j,   L_ij = (g_ij − Σ_{k<j} L_ik L_jk) / L_jj   for i > j
///
/// The code consists of plain loops, because Eigen::LLT takes two seconds of compile time for each size of matrix.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

namespace pseudorigid::mechanics {

template <int n>
class SmallCholesky {
 public:
  /// Reads the lower half of `g`. If g is not positive definite up to round-off, `regular` returns false, and results
  /// of `solve` are not valid.
  explicit SmallCholesky(const Eigen::Matrix<double, n, n>& g) : L_(g) {
    double least = HUGE_VAL, greatest = 0;
    for (int j = 0; j < n; ++j) {
      double d = L_(j, j);
      for (int k = 0; k < j; ++k) d -= L_(j, k) * L_(j, k);
      if (!(d > 0)) return;
      least = std::min(least, d);
      greatest = std::max(greatest, d);
      L_(j, j) = std::sqrt(d);
      for (int i = j + 1; i < n; ++i) {
        for (int k = 0; k < j; ++k) L_(i, j) -= L_(i, k) * L_(j, k);
        L_(i, j) /= L_(j, j);
      }
    }
    regular_ = least > std::numeric_limits<double>::epsilon() * greatest;
  }

  /// Returns true if all d_j are positive and the least d_j is larger than ε times the greatest, with the round-off ε.
  bool regular() const { return regular_; }

  /// Returns g⁻¹x. The matrix must be regular.
  Eigen::Matrix<double, n, 1> solve(Eigen::Matrix<double, n, 1> x) const {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < j; ++k) x[j] -= L_(j, k) * x[k];
      x[j] /= L_(j, j);
    }
    for (int j = n - 1; j >= 0; --j) {
      for (int i = j + 1; i < n; ++i) x[j] -= L_(i, j) * x[i];
      x[j] /= L_(j, j);
    }
    return x;
  }

 private:
  Eigen::Matrix<double, n, n> L_;  // L in the lower half; the upper half is not used
  bool regular_ = false;
};

}  // namespace pseudorigid::mechanics
