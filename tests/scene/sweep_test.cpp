// The values of a sweep's parameters: ranges, logarithmic ranges, Latin hypercubes, parts.
#include "scene/sweep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace pseudorigid::scene {
namespace {

Sweep sweep_of(const std::string& text) {
  Sweep sweep;
  const auto problem = SweepParameters{}.read(text, sweep);
  EXPECT_FALSE(problem) << *problem;
  EXPECT_EQ(SweepParameters{}.print(sweep), text);
  return sweep;
}

TEST(Sweep, LogarithmicRange) {
  const Sweep sweep = sweep_of("g: 0.01 .. 100 in 5 logarithmic");
  ASSERT_EQ(n_runs(sweep), 5);
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(std::log10(values_of_run(sweep, k).at("g")), k - 2, 1e-14);
  EXPECT_EQ(values_of_run(sweep, 0).at("g"), 0.01);
  EXPECT_EQ(values_of_run(sweep, 4).at("g"), 100);
}

TEST(Sweep, LatinHypercube) {
  const Sweep sweep = sweep_of("x: 0 .. 1 in 50 latin 7; w: 2, 3; y: 1 .. 1024 in 50 logarithmic latin 7");
  ASSERT_EQ(n_runs(sweep), 100);
  for (const double w : {2, 3}) {
    std::set<int> xs, ys;
    int n_equal = 0;
    for (int k = 0; k < 100; ++k) {
      const ParameterValues values = values_of_run(sweep, k);
      if (values.at("w") != w) continue;
      const int x = static_cast<int>(50 * values.at("x")), y = static_cast<int>(5 * std::log2(values.at("y")));
      xs.insert(x);
      ys.insert(y);
      n_equal += x == y;
    }
    EXPECT_EQ(xs.size(), 50u);  // one value in each part
    EXPECT_EQ(ys.size(), 50u);
    EXPECT_LT(n_equal, 10);  // of two random permutations one place is expected to be equal
  }
  const Sweep other = sweep_of("x: 0 .. 1 in 50 latin 8; w: 2, 3; y: 1 .. 1024 in 50 logarithmic latin 7");
  EXPECT_NE(values_of_run(other, 0).at("x"), values_of_run(sweep, 0).at("x"));
  EXPECT_EQ(values_of_run(other, 3).at("y"), values_of_run(sweep, 3).at("y"));
}

TEST(Sweep, PartsHaveAllRunsOnce) {
  for (const int n : {1, 7, 100})
    for (const int n_parts : {1, 3, 8}) {
      int next = 0;
      for (int part = 1; part <= n_parts; ++part) {
        const auto [first, end] = runs_of_part({part, n_parts}, n);
        EXPECT_EQ(first, next);
        next = end;
      }
      EXPECT_EQ(next, n);
    }
}

TEST(Sweep, WrongRanges) {
  Sweep sweep;
  for (const char* text : {"g: 0 .. 1 in 5 logarithmic", "g: 1 .. 2 in 5 latin", "g: 1 .. 2 in 5 latin x",
                           "g: 1 .. 2 in 5 log", "g: 1 .. 2 in 5 latin 1; h: 1 .. 2 in 6 latin 1"})
    EXPECT_TRUE(SweepParameters{}.read(text, sweep)) << text;
}

}  // namespace
}  // namespace pseudorigid::scene
