#pragma once
/// The generalized conjugate residual method (Eisenstat, Elman, Schultz 1983) for A x = r₀, whose preconditioner M acts
/// on the right, so that its residuals are those of the system itself. With w = A M⁻¹ r_k,
///
///   y_k = (w − Σ_{j<k} (y_j·w) y_j)/|…|,   z_k likewise, A z_k = y_k,
///   x ← x + (y_k·r_k) z_k,   r_{k+1} = r_k − (y_k·r_k) y_k,   |r_{k+1}|² = |r_k|² − (y_k·r_k)².
///
/// The residual is the least among all x of the iterations, as that of GMRES. As r_k is orthogonal to the y_j before
/// it,
///
///   |w − Σ (y_j·w) y_j|² = w·w − Σ (y_j·w)²,   y_k·r_k = w·r_k/|…|,
///
/// so that an iteration needs one sum over the processes. This is the classical Gram–Schmidt process, which is accurate
/// enough for a small number of iterations.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "mechanics/core/vector_space.h"

namespace pseudorigid::mechanics {

template <class Vector>
class ConjugateResiduals {
 public:
  struct Result {
    int n_iterations = 0;
    bool converged = false;  ///< |r| is at most the tolerance
  };

  /// x from r, which becomes the residual. `multiply(z, y)`: y ← A z; `precondition(r, z)`: z ← M⁻¹ r. Norms are
  /// Euclidean, `norm` that of r. After `n_kept` iterations the y_j are forgotten.
  template <class Multiply, class Precondition>
  Result solve(Multiply&& multiply, Precondition&& precondition, double norm, double tolerance, int max_iterations,
               Vector& r, Vector& x) {
    Result result{0, norm <= tolerance};
    scale(0.0, x);
    double square = norm * norm;
    for (int k = 0; !result.converged && result.n_iterations < max_iterations; k = (k + 1) % n_kept) {
      ++result.n_iterations;
      if (k == static_cast<int>(y_.size())) {
        y_.push_back(r);
        z_.push_back(r);
      }
      Vector &y = y_[k], &z = z_[k];
      precondition(r, z);
      multiply(z, y);
      const double length = orthogonalise(k, r);
      if (!(length > 0)) break;  // nothing new, or not finite
      const double alpha = of_residual_ / length;
      axpy(alpha, z, x);
      axpy(-alpha, y, r);
      square -= alpha * alpha;
      result.converged = square <= tolerance * tolerance;
    }
    return result;
  }

  static constexpr int n_kept = 40;

 private:
  /// Makes y_k orthonormal to those before, and z_k with it; returns its length before it became 1, or 0.
  double orthogonalise(int k, const Vector& r) {
    others_.clear();
    for (int j = 0; j <= k; ++j) others_.push_back(&y_[j]);
    others_.push_back(&r);
    products_.resize(others_.size());
    VectorSpace<Vector>::dots(others_, y_[k], products_);
    double square = products_[k];
    for (int j = 0; j < k; ++j) square -= products_[j] * products_[j];
    of_residual_ = products_[k + 1];
    constexpr double round_off = 1e-14;
    if (!(square > round_off * products_[k])) return 0;
    for (int j = 0; j < k; ++j) {
      axpy(-products_[j], y_[j], y_[k]);
      axpy(-products_[j], z_[j], z_[k]);
    }
    const double length = std::sqrt(square);
    scale(1 / length, y_[k]);
    scale(1 / length, z_[k]);
    return length;
  }

  std::vector<Vector> y_, z_;
  std::vector<const Vector*> others_;
  std::vector<double> products_;
  double of_residual_ = 0;
};

}  // namespace pseudorigid::mechanics
