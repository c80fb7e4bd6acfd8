/// Logarithms of SIMD lanes against the standard library, to 2 units in the last place. Compiled like the kernels, so
/// that the widest vectors of the machine are the ones tested.

#include "mechanics/core/lanes.h"
#include "mechanics/core/lanes_trigonometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace pseudorigid::mechanics {
namespace {

using L = Lanes<native_lanes>;

/// Distance in units of the last place of `expected`.
double ulps(double value, double expected) {
  const double unit = std::nextafter(std::abs(expected), HUGE_VAL) - std::abs(expected);
  return std::abs(value - expected) / unit;
}

template <class OfLanes, class OfDouble>
double worst_error(const std::vector<double>& arguments, const OfLanes& f, const OfDouble& g) {
  double worst = 0;
  for (std::size_t i = 0; i + native_lanes <= arguments.size(); i += native_lanes) {
    L x;
    for (int l = 0; l < native_lanes; ++l) x.set(l, arguments[i + l]);
    const L y = f(x);
    for (int l = 0; l < native_lanes; ++l) worst = std::max(worst, ulps(y[l], g(arguments[i + l])));
  }
  return worst;
}

/// ±exp of numbers uniform in (low, high), shifted.
std::vector<double> spread(double low, double high, double sign = 1, double shift = 0) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(low, high);
  std::vector<double> result(100000);
  for (double& x : result) x = shift + sign * std::exp(uniform(generator));
  return result;
}

const auto lane_log = [](L x) { return log(x); };
const auto lane_log1p = [](L x) { return log1p(x); };
const auto std_log = [](double x) { return std::log(x); };
const auto std_log1p = [](double x) { return std::log1p(x); };

TEST(Lanes, LogarithmOfEveryMagnitude) {
  EXPECT_LE(worst_error(spread(-700, 700), lane_log, std_log), 2);
  EXPECT_LE(worst_error(spread(-1, 1), lane_log, std_log), 2);
}

TEST(Lanes, LogarithmNearOne) {
  EXPECT_LE(worst_error(spread(-36, -1, 1, 1), lane_log, std_log), 2);
  EXPECT_LE(worst_error(spread(-36, -1, -1, 1), lane_log, std_log), 2);
  EXPECT_EQ(log(L(1.0))[0], 0);
}

TEST(Lanes, LogarithmOfOnePlusSmall) {
  EXPECT_LE(worst_error(spread(-300, -0.7), lane_log1p, std_log1p), 2);
  EXPECT_LE(worst_error(spread(-300, -0.7, -1), lane_log1p, std_log1p), 2);
  EXPECT_LE(worst_error(spread(-1, 30), lane_log1p, std_log1p), 2);
  EXPECT_EQ(log1p(L(0.0))[0], 0);
}

TEST(Lanes, InverseSquareRootInTheRangeOfSinglePrecision) {
  const auto lane_root = [](L x) { return inverse_sqrt(x); };
  const auto std_root = [](double x) { return 1 / std::sqrt(x); };
  EXPECT_LE(worst_error(spread(-82, 82), lane_root, std_root), 3);
  EXPECT_LE(worst_error(spread(-1, 1), lane_root, std_root), 3);
}

TEST(Lanes, SumLooksAtActiveLanes) {
  L x(3.0);
  x.set(1, -1.0);
  EXPECT_EQ(x.sum(1), 3);
  EXPECT_EQ(x.sum(2), 2);
}

TEST(Lanes, ANanIsTheLeastWhereverItStands) {
  L x(3.0);
  x.set(1, -1.0);
  EXPECT_EQ(x.least(1), 3);
  EXPECT_EQ(x.least(native_lanes), -1);
  const L one(1.0);
  for (int l = 0; l < native_lanes; ++l) {
    L y = x;
    y.set(l, std::nan(""));
    EXPECT_TRUE(std::isnan(y.least(native_lanes))) << l;
    EXPECT_TRUE(std::isnan(min(y, one)[l]) && std::isnan(min(one, y)[l])) << l;
  }
  EXPECT_EQ(min(x, one)[0], 1);
  EXPECT_EQ(min(x, one)[1], -1);
}

/// Triples of a vector into lanes and back, where two lanes share a triple and the last lane has no cell of its own.
TEST(Lanes, TriplesAreReadAndAddedLaneByLane) {
  std::vector<double> values(3 * (native_lanes + 1));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i);
  unsigned int offsets[native_lanes];
  for (int l = 0; l < native_lanes; ++l) offsets[l] = 3 * (native_lanes - l);
  offsets[1] = offsets[0];
  L x, y, z;
  L::load_triples(values.data(), offsets, x, y, z);
  for (int l = 0; l < native_lanes; ++l) {
    EXPECT_EQ(x[l], offsets[l]);
    EXPECT_EQ(y[l], offsets[l] + 1);
    EXPECT_EQ(z[l], offsets[l] + 2);
  }
  std::vector<double> expected = values;
  for (int l = 0; l + 1 < native_lanes; ++l)
    for (int c = 0; c < 3; ++c) expected[offsets[l] + c] += offsets[l] + c;
  L::add_triples(x, y, z, native_lanes - 1, values.data(), offsets);
  EXPECT_EQ(values, expected);
}

/// Near multiples of π/2 the error is counted in units of 1.
TEST(Lanes, SineAndCosineAreThoseOfTheLibrary) {
  const auto sine = [](L x) { return sine_cosine(x).sine; };
  const auto cosine = [](L x) { return sine_cosine(x).cosine; };
  for (const double sign : {1.0, -1.0}) {
    const auto small = spread(-40, std::log(0.7), sign);
    EXPECT_LE(worst_error(small, sine, [](double x) { return std::sin(x); }), 1.5);
    EXPECT_LE(worst_error(small, cosine, [](double x) { return std::cos(x); }), 1.5);
    for (const auto& arguments : {spread(-1, 13, sign), spread(13, 100, sign)})
      for (std::size_t i = 0; i + native_lanes <= arguments.size(); i += native_lanes) {
        L x;
        for (int l = 0; l < native_lanes; ++l) x.set(l, arguments[i + l]);
        const auto y = sine_cosine(x);
        for (int l = 0; l < native_lanes; ++l) {
          ASSERT_NEAR(y.sine[l], std::sin(x[l]), 2.3e-16) << x[l];
          ASSERT_NEAR(y.cosine[l], std::cos(x[l]), 2.3e-16) << x[l];
        }
      }
  }
}

}  // namespace
}  // namespace pseudorigid::mechanics
