#pragma once
/// Gaussian elimination without pivoting for a small dense system S x = r, unrolled by the compiler. The method is
/// stable for a matrix S close to a symmetric positive definite matrix. An example is G(q₁)M⁻¹G(q₀)ᵀ with the
/// derivative G of constraints and the mass operator M. The configurations q₁ and q₀ must then be close to each other.

#include <Eigen/Core>
#include <cmath>

namespace pseudorigid::systems {

/// Solves the system. The argument x contains r before the call and the solution afterwards. Returns false if the
/// result is not finite, for example because a pivot is zero.
template <int n>
bool solve_by_elimination(Eigen::Matrix<double, n, n> S, Eigen::Matrix<double, n, 1>& x) {
#pragma GCC unroll 8
  for (int k = 0; k < n; ++k) {
    S(k, k) = 1 / S(k, k);
#pragma GCC unroll 8
    for (int i = k + 1; i < n; ++i) {
      const double factor = S(i, k) * S(k, k);
#pragma GCC unroll 8
      for (int j = k + 1; j < n; ++j) S(i, j) -= factor * S(k, j);
      x(i) -= factor * x(k);
    }
  }
#pragma GCC unroll 8
  for (int k = n - 1; k >= 0; --k) {
#pragma GCC unroll 8
    for (int j = k + 1; j < n; ++j) x(k) -= S(k, j) * x(j);
    x(k) *= S(k, k);
  }
  return std::isfinite(x.squaredNorm());
}

}  // namespace pseudorigid::systems
