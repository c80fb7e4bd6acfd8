/// The sums over pairs compiled for each level of x86-64 that this processor has are the same to round-off, with any
/// number of lanes.

#include "gravity/levels.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pseudorigid::testing {
namespace {

/// Not a multiple of any number of lanes.
constexpr int n_points = 37;

/// Points about the unit sphere with x, y, z > 0, areas along them; `phase` makes another set.
gravity::SurfacePoints points(double phase) {
  gravity::SurfacePoints points;
  for (int i = 0; i < n_points; ++i) {
    const Eigen::Vector3d x(1.2 + std::sin(1.3 * i + phase), 1.1 + std::cos(2.1 * i + phase), 1.5 + std::sin(0.7 * i));
    points.add(x.normalized(), (0.1 + 0.01 * std::cos(i + phase)) * x);
  }
  return points;
}

void expect_near(const std::vector<double>& found, const std::vector<double>& expected, std::string_view level) {
  double size = 0;
  for (const double value : expected) size = std::max(size, std::abs(value));
  ASSERT_GT(size, 1e-3);
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], 1e-13 * size) << level << ": sums of 37 or 296 terms";
}

void expect_near(const gravity::PairSums& found, const gravity::PairSums& expected, std::string_view level) {
  expect_near(found.e, expected.e, level);
  for (int c = 0; c < 3; ++c) {
    expect_near(found.g[c], expected.g[c], level);
    expect_near(found.h[c], expected.h[c], level);
  }
}

TEST(PairSumsOfLevels, AgreeToRoundOff) {
  const auto targets = points(0), sources = points(2);
  const gravity::Moving<gravity::SurfacePoints> moving{targets, points(4)}, others{sources, points(6)};
  const gravity::PairKernels* first = nullptr;
  int n_levels = 0;
  for (const auto& build : builds_of_all_levels()) {
    if (!build.runs_here()) continue;
    ++n_levels;
    const gravity::PairKernels& kernels = *build.table;
    if (!first) first = &kernels;
    expect_near(kernels.sum(targets, sources), first->sum(targets, sources), build.instructions);
    for (const std::array<bool, 3> mirrors : {std::array{false, false, false}, std::array{true, true, true}})
      expect_near(kernels.sum_own(targets, mirrors), first->sum_own(targets, mirrors), build.instructions);
    const auto found = kernels.sum_moving(moving, others), expected = first->sum_moving(moving, others);
    expect_near(found.at, expected.at, build.instructions);
    expect_near(found.rate, expected.rate, build.instructions);
  }
  if (n_levels < 2) GTEST_SKIP() << "there is nothing to compare on this processor";
}

}  // namespace
}  // namespace pseudorigid::testing
