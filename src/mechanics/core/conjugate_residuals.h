#pragma once
/// The generalized conjugate residual method (Eisenstat, Elman, Schultz 1983), truncated as Orthomin, solves A x = r₀
/// for a nearly symmetric matrix A. The preconditioner M acts on the right, so the residuals are r_k = r₀ − A x. With w
/// = A M⁻¹ r_k, iteration k computes a vector y_k of length 1 and a direction z_k with A z_k = y_k. The sums run over
/// the last m indices j < k. |…| is the length of the numerator of y_k:
///
///   y_k = (w − Σ (y_j·w) y_j)/|…|,   z_k = (M⁻¹ r_k − Σ (y_j·w) z_j)/|…|,
///   x ← x + (y_k·r_k) z_k,   r_{k+1} = r_k − (y_k·r_k) y_k,   |r_{k+1}|² = |r_k|² − (y_k·r_k)².
///
/// If the sums include all j < k, |r_{k+1}| is the least in the Krylov space. The same least is reached with m = 1 if A
/// M⁻¹ is symmetric and positive definite. If A is symmetric and M is close to A, A M⁻¹ nearly has these properties,
/// and a small m suffices. Since r_k is orthogonal to the y_j in the sums,
///
///   |w − Σ (y_j·w) y_j|² = w·w − Σ (y_j·w)²,   y_k·r_k = w·r_k/|…|.
///
/// All scalar products of an iteration are therefore known after one sum over the processes. The orthogonalisation is
/// the classical Gram–Schmidt process, which is accurate enough for a small number of vectors. The difference |r_k|² −
/// (y_k·r_k)² has an error of 1e-16 |r₀|². The error of |r| is then up to 1e-8 |r₀|, so the tolerance should be at
/// least 1e-7 |r₀|.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "mechanics/core/vector_space.h"

namespace pseudorigid::mechanics {

template <class Vector>
class ConjugateResiduals {
 public:
  struct Result {
    int n_iterations = 0;
    bool converged = false;  ///< true if the final |r| is at most the tolerance
  };

  /// Solves A x = r from the guess x = 0, and sets r to the remaining residual. The iteration ends if |r| is at most
  /// `tolerance`, after `max_iterations`, or if a new direction is round-off or not finite. In all cases x is the last
  /// iterate. If |r| is still above `tolerance` after n_with_few iterations, the method restarts from x with m =
  /// n_kept_if_slow. `multiply(z, y)` sets y ← A z, and `precondition(r, z)` sets z ← M⁻¹ r. On entry `norm` is the
  /// Euclidean norm |r|. All processes call the function together.
  template <class Multiply, class Precondition>
  Result solve(Multiply&& multiply, Precondition&& precondition, double norm, double tolerance, int max_iterations,
               Vector& r, Vector& x) {
    Result result{0, norm <= tolerance};
    scale(0.0, x);
    double square = norm * norm;
    const auto iterate = [&](int m, int most) {
      n_slots_ = m + 1;
      for (int k = 0; !result.converged && result.n_iterations < most; ++k) {
        ++result.n_iterations;
        const auto slot = static_cast<std::size_t>(k % n_slots_);
        if (slot == y_.size()) {
          y_.push_back(r);
          z_.push_back(r);
        }
        precondition(r, z_[slot]);
        multiply(z_[slot], y_[slot]);
        const double length = orthogonalise(k, r);
        if (!(length > 0)) return;  // the new direction is round-off or not finite
        const double alpha = of_residual_ / length;
        axpy(alpha, z_[slot], x);
        axpy(-alpha, y_[slot], r);
        square -= alpha * alpha;
        result.converged = square <= tolerance * tolerance;
      }
    };
    iterate(n_kept, std::min(n_with_few, max_iterations));
    if (result.n_iterations == n_with_few) iterate(n_kept_if_slow, max_iterations);
    return result;
  }

  /// Number m of vectors y_j in the sums. With m = 1, the iteration does not converge for the Gram systems of finite
  /// elements of degree 6. In measurements with 1100 … 410,000 unknowns, the numbers of iterations with m = 2 … 6 and
  /// with all vectors agreed within 2 %. For the largest system, the scalar products with all vectors took a tenth of
  /// the time of a step. The value 6 leaves a reserve.
  static constexpr int n_kept = 6;
  /// If n_with_few iterations are not enough, M is not close to A. The method then restarts from the last iterate with
  /// m = n_kept_if_slow.
  static constexpr int n_with_few = 40, n_kept_if_slow = 40;

 private:
  /// On entry y_k contains w, z_k contains M⁻¹ r_k, and r is r_k. Makes y_k orthogonal to the previous y_j and of
  /// length 1, and changes z_k such that A z_k = y_k. Returns the length |w − Σ (y_j·w) y_j|, or 0 if only round-off
  /// remains or a number is not finite. Sets of_residual_ to w·r_k.
  double orthogonalise(int k, const Vector& r) {
    const std::size_t n = std::min(k, n_slots_ - 1);
    Vector &y = y_[k % n_slots_], &z = z_[k % n_slots_];
    const auto collect_before = [&](const std::vector<Vector>& vectors) {
      before_.clear();
      for (int j = k - static_cast<int>(n); j < k; ++j) before_.push_back(&vectors[j % n_slots_]);
    };
    collect_before(y_);
    before_.push_back(&y);
    before_.push_back(&r);
    products_.resize(n + 2);
    VectorSpace<Vector>::dots(before_, y, products_);
    const double of_itself = products_[n];
    of_residual_ = products_[n + 1];
    double square = of_itself;
    for (std::size_t j = 0; j < n; ++j) {
      square -= products_[j] * products_[j];
      products_[j] = -products_[j];
    }
    constexpr double round_off = 1e-14;
    if (!(square > round_off * of_itself)) return 0;
    const double length = std::sqrt(square);
    const std::span<const double> weights(products_.data(), n);
    VectorSpace<Vector>::combine(1 / length, y, weights, std::span(before_).first(n));
    collect_before(z_);
    VectorSpace<Vector>::combine(1 / length, z, weights, before_);
    return length;
  }

  std::vector<Vector> y_, z_;  // y_k and z_k are in slot k mod n_slots_
  int n_slots_ = 0;
  std::vector<const Vector*> before_;
  std::vector<double> products_;
  double of_residual_ = 0;
};

}  // namespace pseudorigid::mechanics
