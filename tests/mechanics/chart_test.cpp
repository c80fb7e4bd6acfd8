/// Charts beyond the statements of the book: automatic differentiation, failures, central differences.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mechanics/core/central_difference.h"
#include "mechanics/core/chart_field.h"
#include "support/surface_curves.h"
#include "systems/torus.h"

namespace pseudorigid::testing {
namespace {

using Eigen::Vector2d;
using mechanics::ChartField;

/// A chart with an external force that depends on time, F = (t, v₁), and nothing else.
struct DrivenPlane {
  static constexpr int dimension = 2;
  template <class T>
  Eigen::Matrix<T, 2, 2> metric(const mechanics::Coordinates<T, 2>&) const {
    Eigen::Matrix<T, 2, 2> g;
    g << T(2.0), T(0.0), T(0.0), T(4.0);
    return g;
  }
  Vector2d external_force(double t, const Vector2d&, const Vector2d& v) const { return {t, v[0]}; }
};

TEST(AutomaticDifferentiation, SecondOrderJetOfAFunction) {
  const Vector2d q(0.7, -1.2);
  const auto jet = mechanics::second_order_jet<2>(
      [](const auto& x) -> std::decay_t<decltype(x[0])> { return sin(x[0]) * exp(x[1] * x[0]); }, q);
  const double s = std::sin(0.7), c = std::cos(0.7), e = std::exp(0.7 * -1.2), x = 0.7, y = -1.2;
  constexpr double eps = 1e-15;  // a few roundings of numbers below 1
  EXPECT_NEAR(jet.value, s * e, eps);
  EXPECT_NEAR(jet.gradient[0], (c + y * s) * e, eps);
  EXPECT_NEAR(jet.gradient[1], x * s * e, eps);
  EXPECT_NEAR(jet.hessian(0, 0), (-s + 2 * y * c + y * y * s) * e, 4 * eps);
  EXPECT_NEAR(jet.hessian(0, 1), (s + x * c + x * y * s) * e, 4 * eps);
  EXPECT_NEAR(jet.hessian(1, 0), jet.hessian(0, 1), eps);
  EXPECT_NEAR(jet.hessian(1, 1), x * x * s * e, eps);
}

TEST(ChartField, ExternalForcesActThroughTheMetric) {
  const ChartField field(DrivenPlane{});
  auto w = field.make_workspace();
  Vector2d a;
  ASSERT_TRUE(field.acceleration(3, {0, 0}, {0.5, 1}, w, a));
  EXPECT_LT((a - Vector2d(1.5, 0.125)).norm(), 1e-15);
  EXPECT_TRUE(field.velocity_dependent());
  EXPECT_FALSE(field.dissipative());
  EXPECT_TRUE(ChartField<systems::Torus>::dissipative());
  EXPECT_FALSE(ChartField<systems::Sphere>::velocity_dependent());
}

TEST(ChartField, SingularMetricIsAReport) {
  const ChartField field(systems::Sphere{});
  auto w = field.make_workspace();
  Vector2d a(1, 2);
  for (const double theta : {0.0, 1e-9, std::numbers::pi}) {
    const auto status = field.acceleration(0, {theta, 0.3}, {0.1, 0.2}, w, a);
    EXPECT_FALSE(status);
    EXPECT_NE(status.reason().find("metric of the chart is singular"), std::string::npos) << status.reason();
  }
  EXPECT_TRUE(field.acceleration(0, {1e-6, 0.3}, {0.1, 0.2}, w, a));
}

TEST(ChartField, NumbersThatAreNotFiniteAreAReport) {
  const ChartField field(systems::Torus{});
  auto w = field.make_workspace();
  Vector2d a;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(field.acceleration(0, {nan, 0}, {0.1, 0.2}, w, a));
  EXPECT_FALSE(field.acceleration(0, {0.1, 0}, {nan, 0.2}, w, a));
  EXPECT_FALSE(field.acceleration(0, {0.1, HUGE_VAL}, {0.1, 0.2}, w, a));
}

TEST(CentralDifference, IsOfOrder8) {
  const auto error = [](double h) {
    Eigen::VectorXd derivative = Eigen::VectorXd::Zero(1);
    const auto F = [](double s, Eigen::VectorXd& y) {
      y = Eigen::VectorXd::Constant(1, std::exp(s));
      return mechanics::Status();
    };
    EXPECT_TRUE(mechanics::central_difference(F, h, derivative));
    return std::abs(derivative[0] - 1);
  };
  EXPECT_NEAR(std::log2(error(0.5) / error(0.25)), 8, 0.1);
  EXPECT_LT(error(0.01), 1e-13);  // round-off ε/h
}

TEST(CentralDifference, HandsOnAFailure) {
  Eigen::VectorXd derivative = Eigen::VectorXd::Zero(1);
  const auto F = [](double s, Eigen::VectorXd&) {
    return s < 0 ? mechanics::Status::failure("negative") : mechanics::Status();
  };
  EXPECT_EQ(mechanics::central_difference(F, 0.1, derivative).reason(), "negative");
}

}  // namespace
}  // namespace pseudorigid::testing
