/// The zero of a function between two points.

#include "mechanics/core/bracketed_root.h"

#include <gtest/gtest.h>

namespace pseudorigid::mechanics {
namespace {

TEST(BracketedRoot, IsFoundToTheLastDigit) {
  const auto root = bracketed_root([](double x) { return x * x * x - 2; }, 0, 8);
  ASSERT_TRUE(root);
  EXPECT_NEAR(*root, std::cbrt(2.0), 3e-16);
  EXPECT_EQ(bracketed_root([](double x) { return x - 1; }, 1, 3), 1.0);
  EXPECT_EQ(bracketed_root([](double x) { return x - 3; }, 1, 3), 3.0);
}

TEST(BracketedRoot, IsNothingWithoutAChangeOfSignOrWhereTheFunctionIsNoNumber) {
  EXPECT_FALSE(bracketed_root([](double x) { return x * x + 1; }, -1, 2));
  EXPECT_FALSE(bracketed_root([](double x) { return std::abs(x) < 0.1 ? std::nan("") : x; }, -1, 1));
  EXPECT_FALSE(bracketed_root([](double x) { return std::abs(x) < 0.1 ? HUGE_VAL : x; }, -1, 1));
  EXPECT_FALSE(bracketed_root([](double x) { return std::sqrt(x) - 1; }, -1, 4));
}

}  // namespace
}  // namespace pseudorigid::mechanics
