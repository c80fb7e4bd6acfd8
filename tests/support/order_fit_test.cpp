#include "support/order_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace {

using pseudorigid::testing::ErrorPoint;
using pseudorigid::testing::fit_order;
using pseudorigid::testing::OrderFit;

std::vector<ErrorPoint> halvings(int n, const std::function<double(double)>& error) {
  std::vector<ErrorPoint> points;
  for (int i = 0; i < n; ++i) points.push_back({std::ldexp(0.2, -i), error(std::ldexp(0.2, -i))});
  return points;
}

TEST(OrderFit, PureLawIsExact) {
  const OrderFit fit = fit_order(halvings(5, [](double h) { return 3 * std::pow(h, 4); }));
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit.order, 4, 1e-12);
  EXPECT_NEAR(fit.constant, 3, 1e-11);
  EXPECT_LT(fit.standard_error, 1e-12);
  EXPECT_EQ(fit.n_used, 5u);
  EXPECT_EQ(fit.plateau, 0);
}

/// Orders 2, 4, 6, 8 within 0.1, although most of the points of the high orders lie on the plateau.
TEST(OrderFit, PlateauIsDropped) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> scatter(-1, 1);
  for (int run = 0; run < 200; ++run)
    for (const int order : {2, 4, 6, 8}) {
      const auto points = halvings(
          9, [&](double h) { return std::abs(0.3 * std::pow(h, order) * (1 + h * h) + 3e-15 * scatter(generator)); });
      const OrderFit fit = fit_order(points);
      ASSERT_TRUE(fit) << "order " << order;
      EXPECT_NEAR(fit.order, order, 0.1) << fit.n_used << " points";
      EXPECT_LT(fit.plateau, 4e-15);
    }
}

TEST(OrderFit, PointsComeInAnyOrder) {
  std::vector<ErrorPoint> points = halvings(7, [](double h) { return std::pow(h, 6) + 1e-13; });
  const OrderFit sorted = fit_order(points);
  std::swap(points[0], points[5]);
  std::swap(points[2], points[6]);
  EXPECT_EQ(fit_order(points).order, sorted.order);
  EXPECT_EQ(fit_order(points).n_used, sorted.n_used);
}

TEST(OrderFit, ScatterGivesAStandardError) {
  const OrderFit fit = fit_order(halvings(6, [](double h) { return std::pow(h, 2) * (1 + 0.2 * std::sin(50 / h)); }));
  ASSERT_TRUE(fit);
  EXPECT_GT(fit.standard_error, 0.01);
  EXPECT_NEAR(fit.order, 2, 3 * fit.standard_error);
}

TEST(OrderFit, ASuperconvergentDipDoesNotEndTheRange) {
  std::vector<ErrorPoint> points = halvings(7, [](double h) { return std::pow(h, 4); });
  points[3].error /= 3;
  const OrderFit fit = fit_order(points);
  EXPECT_EQ(fit.n_used, 7u);
  EXPECT_NEAR(fit.order, 4, 0.1);
}

TEST(OrderFit, AMethodThatIsExactHasNoOrder) {
  const OrderFit fit = fit_order(halvings(6, [](double h) { return 1e-15 * (1 + 0.5 * std::sin(100 / h)); }));
  EXPECT_FALSE(fit);
  EXPECT_TRUE(std::isnan(fit.order));
}

TEST(OrderFit, AGrowingErrorHasNoOrder) {
  EXPECT_FALSE(fit_order(halvings(5, [](double h) { return 1 / h; })));
}

TEST(OrderFit, TwoPointsGiveASlopeWithoutError) {
  const OrderFit fit = fit_order(halvings(2, [](double h) { return h * h; }));
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit.order, 2, 1e-13);
  EXPECT_TRUE(std::isinf(fit.standard_error));
}

TEST(OrderFit, UnusableInput) {
  EXPECT_FALSE(fit_order({}));
  EXPECT_FALSE(fit_order(halvings(1, [](double h) { return h; })));
  EXPECT_THROW((void)fit_order(std::vector<ErrorPoint>{{0.1, 1}, {0.1, 2}}), std::invalid_argument);
  std::vector<ErrorPoint> points = halvings(5, [](double h) { return h * h; });
  points[1].error = 0;
  points[3].error = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fit_order(points).n_used, 3u);
}

}  // namespace
