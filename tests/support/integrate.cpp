#include "support/integrate.h"

#include <gtest/gtest.h>

#include "mechanics/methods/dormand_prince_8.h"

namespace pseudorigid::testing::detail {

std::vector<FlatState> integrate_to(const FlatField& field, FlatState state, const std::vector<double>& times,
                                    double tolerance) {
  mechanics::DormandPrince8Workspace<FlatField> workspace(field, tolerance);
  std::vector<FlatState> samples;
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

FlatState integrate(const FlatField& field, FlatState state, double t_end, double tolerance) {
  mechanics::DormandPrince8Workspace<FlatField> workspace(field, tolerance);
  while (state.t != t_end) {
    const auto status = mechanics::DormandPrince8::step(field, t_end, state, workspace);
    EXPECT_TRUE(status) << status.reason();
    if (!status) break;
  }
  return state;
}

}  // namespace pseudorigid::testing::detail
