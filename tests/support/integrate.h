#pragma once
/// Accurate solutions for tests, by the explicit method of order 8.

#include <gtest/gtest.h>

#include <vector>

#include "mechanics/methods/dormand_prince_8.h"

namespace pseudorigid::testing {

/// The states of a second-order field at the given rising times, the first of which is not before the state's. Times
/// between steps are interpolated.
template <mechanics::SecondOrderField F>
std::vector<mechanics::State<F>> integrate_to(const F& field, mechanics::State<F> state,
                                              const std::vector<double>& times, double tolerance = 1e-13) {
  mechanics::DormandPrince8Workspace<F> workspace(field, tolerance);
  std::vector<mechanics::State<F>> samples;
  for (const double t : times) {
    while (state.t < t) {
      const auto status = mechanics::DormandPrince8::step(field, times.back(), state, workspace);
      EXPECT_TRUE(status) << status.reason();
      if (!status) return samples;
    }
    samples.push_back(state);
    if (t == state.t) continue;
    const auto status = mechanics::DormandPrince8::interpolate(field, t, samples.back(), workspace);
    EXPECT_TRUE(status) << status.reason();
  }
  return samples;
}

/// The states at n + 1 equidistant times from the state's to t_end.
template <mechanics::SecondOrderField F>
std::vector<mechanics::State<F>> integrate_samples(const F& field, const mechanics::State<F>& state, double t_end,
                                                   int n, double tolerance = 1e-13) {
  std::vector<double> times;
  for (int k = 0; k <= n; ++k) times.push_back(k == n ? t_end : state.t + (t_end - state.t) * k / n);
  return integrate_to(field, state, times, tolerance);
}

/// The state at t_end (before state.t: backwards).
template <mechanics::SecondOrderField F>
mechanics::State<F> integrate(const F& field, mechanics::State<F> state, double t_end, double tolerance = 1e-13) {
  mechanics::DormandPrince8Workspace<F> workspace(field, tolerance);
  while (state.t != t_end) {
    const auto status = mechanics::DormandPrince8::step(field, t_end, state, workspace);
    EXPECT_TRUE(status) << status.reason();
    if (!status) break;
  }
  return state;
}

}  // namespace pseudorigid::testing
