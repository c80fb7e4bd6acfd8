/// Errors from the differences of successive runs.

#include "analysis/space_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace pseudorigid::analysis;

/// Differences of runs whose errors are C N⁻ᵖ and of one sign.
SpaceErrorLadder algebraic(double C, double p, const std::vector<double>& resolutions) {
  SpaceErrorLadder ladder;
  double before = 0;
  for (const double N : resolutions) {
    const double e = C * std::pow(N, -p);
    ladder.add(N, std::abs(before - e));
    before = e;
  }
  return ladder;
}

TEST(SpaceError, OfAnAlgebraicSeriesIsExact) {
  for (const double p : {2.6, 3.0, 4.4, 5.9}) {
    const SpaceErrorLadder ladder = algebraic(0.7, p, {2, 3, 4, 6.4});
    EXPECT_NEAR(ladder.rate(), p, 1e-9);
    EXPECT_NEAR(ladder.error(), 0.7 * std::pow(6.4, -p), 1e-9 * 0.7 * std::pow(6.4, -p));
    EXPECT_NEAR(ladder.predicted_error(8), 0.7 * std::pow(8, -p), 1e-9 * 0.7 * std::pow(8, -p));
  }
}

TEST(SpaceError, OfTwoRunsTakesTheAssumedRateInBothDirections) {
  const auto e = [](double N) { return 3 * std::pow(N, -assumed_space_rate); };
  EXPECT_NEAR(space_error(e(3) - e(4), 4, 3), e(4), 1e-15);
  EXPECT_NEAR(space_error(e(2) - e(3), 2, 3), e(2), 1e-15);
  EXPECT_NEAR(algebraic(3, assumed_space_rate, {2, 3}).error(), e(3), 1e-15);
}

TEST(SpaceError, IsUnknownOfOneRun) {
  EXPECT_TRUE(std::isinf(SpaceErrorLadder().predicted_error(2)));
  EXPECT_TRUE(std::isinf(algebraic(1, 4, {2}).error()));
  EXPECT_TRUE(std::isinf(algebraic(1, 4, {2}).predicted_error(3)));
}

TEST(SpaceError, DoesNotTrustChance) {
  // Two runs that come close by accident, and one that is no better than the one before.
  SpaceErrorLadder lucky, stagnant;
  for (const double d : {0.0, 1e-2, 1e-9}) lucky.add(2.0 + static_cast<double>(lucky.n_runs()), d);
  for (const double d : {0.0, 1e-3, 1e-2}) stagnant.add(2.0 + static_cast<double>(stagnant.n_runs()), d);
  EXPECT_NEAR(lucky.rate(), largest_space_rate, 1e-9);
  EXPECT_NEAR(stagnant.rate(), least_space_rate, 1e-9);
  EXPECT_GT(stagnant.error(), 0.9e-2);
}

/// Of bodies whose errors fall more slowly.
TEST(SpaceError, TakesALeastRateOfItsOwn) {
  SpaceErrorLadder slow(least_polynomial_rate), other;
  for (SpaceErrorLadder* ladder : {&slow, &other})
    for (const double N : {3.0, 5.0, 7.0}) ladder->add(N, N < 5 ? 0 : std::pow(N - 2, -1.6) - std::pow(N, -1.6));
  EXPECT_NEAR(slow.rate(), 1.6, 1e-9);
  EXPECT_NEAR(slow.error(), std::pow(7, -1.6), 1e-9);
  EXPECT_LT(other.error(), 0.7 * slow.error());
}

/// Errors that alternate in sign are met at their sum: the estimate may be too large, not too small.
TEST(SpaceError, IsOnTheSafeSideWhereErrorsAlternate) {
  for (const double p : {3.0, 4.0, 5.0}) {
    SpaceErrorLadder ladder;
    double before = 0, e = 0;
    for (const int k : {2, 3, 4, 5, 6}) {
      e = (k % 2 ? -1 : 1) * std::pow(k, -p);
      ladder.add(k, std::abs(e - before));
      before = e;
    }
    EXPECT_GE(ladder.error(), std::abs(e));
    EXPECT_LE(ladder.error(), 8 * std::abs(e));
  }
}

}  // namespace
