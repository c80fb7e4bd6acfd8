#pragma once
/// Extrapolation of the multiplier to a time t from its values λ(t_i) at earlier times:
///
///   λ(t) ≈ Σ_i ℓ_i(t) λ(t_i) with Lagrange's polynomials ℓ_i.

#include <array>
#include <cmath>
#include <utility>

#include "mechanics/core/vector_space.h"

namespace pseudorigid::mechanics {

/// The last multipliers and their extrapolation. The extrapolating polynomial is linear for systems with dense vectors
/// and cubic for systems with distributed vectors. In a small system, extrapolation of higher order would cost as much
/// as the constraint solves that it saves.
template <class S>
struct MultiplierHistory {
  static constexpr int n_values = VectorSpace<typename S::Vector>::dense ? 2 : 4;
  std::array<typename S::Multiplier, n_values> values;  ///< the multipliers λ(t_i), the latest first
  std::array<double, n_values> times{};                 ///< the times t_i
  int n_known = 0;                                      ///< number of recorded values

  explicit MultiplierHistory(const S& system) {
    for (auto& value : values) value = system.make_multiplier();
  }

  /// Stores λ(t) = lambda, and drops the oldest value if the history is full.
  void record(double t, const typename S::Multiplier& lambda) {
    for (int i = n_values - 1; i > 0; --i) {
      std::swap(values[i], values[i - 1]);
      times[i] = times[i - 1];
    }
    values[0] = lambda;
    times[0] = t;
    if (n_known < n_values) ++n_known;
  }

  /// Passes each member that a checkpoint must contain to `visit`.
  template <class Visit>
  void visit_memory(Visit&& visit) {
    for (auto& value : values) visit(value);
    for (double& time : times) visit(time);
    visit(n_known);
  }

  /// Sets lambda to Σ ℓ_i(t) λ(t_i). The sum contains as many of the latest times as possible such that Σ|ℓ_i(t)| is at
  /// most 16. Without this bound, an extrapolation far beyond close times would amplify round-off. If n_known is 0,
  /// sets lambda to the latest entry of `values`, which is zero at the start of a run.
  void guess(double t, typename S::Multiplier& lambda) const {
    std::array<double, n_values> weights{};
    for (int n = n_known; n > 0; --n)
      if (lagrange(t, n, weights)) break;
    lambda = values[0];
    if (n_known == 0) return;
    scale(weights[0], lambda);
    for (int i = 1; i < n_values; ++i)
      if (weights[i] != 0) axpy(weights[i], values[i], lambda);
  }

 private:
  /// Sets `weights` to ℓ_i(t) for the latest n times. Returns false if Σ|ℓ_i(t)| exceeds 16, or if two times are equal.
  ///
  /// If t is one interval after n equidistant times, Σ|ℓ_i| = 2ⁿ − 1 is at most 15 and permitted. Only steps of unequal
  /// lengths can exceed the limit. Examples are the substeps of compositions, and steps that were halved and become
  /// longer again. The effect of the limit was measured for linear extrapolation, in motions of a pseudo-rigid body
  /// with the steps h = 0.2, 0.05, 0.01. The numbers of constraint iterations agree within 0.5 % for limits from 7 to
  /// 40. A limit of 3 needs up to 2.5 % more iterations. A limit of 1, which means no extrapolation, needs up to 5 %
  /// more in compositions and 16 % more in RATTLE.
  bool lagrange(double t, int n, std::array<double, n_values>& weights) const {
    constexpr double most = 16;
    double sum = 0;
    weights.fill(0);
    for (int i = 0; i < n; ++i) {
      weights[i] = 1;
      for (int j = 0; j < n; ++j)
        if (j != i) weights[i] *= (t - times[j]) / (times[i] - times[j]);
      sum += std::abs(weights[i]);
    }
    return sum <= most;
  }
};

}  // namespace pseudorigid::mechanics
