/// The periodic tide on the finite-element ball: the energy that it gives (affine states: loads_test.cpp).

#include <gtest/gtest.h>

#include <vector>

#include "continuum/balls.h"
#include "support/differences.h"
#include "support/order_fit.h"

namespace pseudorigid::testing {
namespace {

using continuum::Vector;

loads::PeriodicTide tide_on(const Sector& sector) { return all_loads(sector).get<loads::PeriodicTide>(); }

template <class Ball>
class BallUnderATide : public ::testing::Test {};
using BothBalls = ::testing::Types<ElasticBall, CompressibleBall>;
TYPED_TEST_SUITE(BallUnderATide, BothBalls);

/// Kinetic + elastic + external is constant to the order of the method, external less what the tide has given. The
/// centre of mass moves too.
TYPED_TEST(BallUnderATide, KeepsItsBalanceOfEnergy) {
  loads::PeriodicTide tide = tide_on(quarter);
  tide.frequency = 2.3;
  const TypeParam ball(quarter, 2, 0, ciarlet_geymonat, {tide});
  continuum::BallState start = affine_state(ball, diagonal(1.1, 1, 1 / 1.1), diagonal(0.22, 0.1, -0.3 / 1.1));
  start.q.add(1.0, ball.affine_field(Matrix3d::Zero(), Vector3d(0, 0, 0.4)));
  EXPECT_TRUE(ball.time_dependent() && !ball.dissipative() && !ball.velocity_dependent());
  std::vector<ErrorPoint> points;
  double given = 0;
  for (const long n : {40, 80, 160}) {
    const auto r = run<mechanics::Rattle>(ball, start, 1, 1, n);
    ASSERT_TRUE(r.finished()) << r.result.reason;
    const double change = observed(ball, r.last(), {{.multiplier = false}}).energy() -
                          observed(ball, start, {{.multiplier = false}}).energy();
    points.push_back({1.0 / static_cast<double>(n), std::abs(change)});
    given = ball.given(r.last().v);
  }
  EXPECT_GT(std::abs(given), 1e-2);
  EXPECT_LT(points.back().error, 1e-3 * std::abs(given));
  const auto fit = fit_order(points);
  EXPECT_GE(fit.n_used, 3u);
  EXPECT_NEAR(fit.order, 2, 0.15);
}

/// Whatever a load that depends on time may do: its force is −∂V/∂x and its power ∂V/∂t, both of the V of observables.
TEST(DrivingForces, AreThoseOfTheirEnergy) {
  const CompressibleBall ball(whole, 2, 0, neo_hookean, {tide_on(whole)});
  std::mt19937 generator(5);
  const Matrix3d A = random_matrix(generator);
  const loads::Forcing forcing{.quadratic = A + A.transpose(),
                               .acceleration = random_matrix(generator).col(0),
                               .nominal_traction = random_matrix(generator),
                               .pressure = 0.3};
  const auto potential = [&](const Vector& x) {
    const auto sums = ball.integrals(x, x);
    Matrix3d F;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) F(i, j) = sums.F[i][j];
    return forcing.potential(ball.nodal_moment(x, x), ball.mass() * ball.mean(x), F, sums.volume);
  };
  Vector x = random_field(ball.space().reference_positions(), generator), direction = x, f = ball.make_vector();
  direction = random_field(direction, generator);
  x *= 0.02;
  x += ball.affine_field(Matrix3d::Identity() + 0.2 * A, Vector3d(0.3, 0.1, -0.2));
  for (unsigned int c = 0; c < 3; ++c) x.local_element(*ball.space().account() + c) = 0;
  ball.loads().add_driving(forcing, x, f);
  const double h = 0.005, by_difference = first_difference(
                              [&](int k) {
                                Vector moved = x;
                                moved.add(k * h, direction);
                                return potential(moved);
                              },
                              h);
  EXPECT_NEAR(-(f * direction), by_difference, 1e-10 * (1 + std::abs(by_difference)));
  EXPECT_NEAR(ball.loads().driving_power(forcing, x), potential(x), 1e-13 * (1 + std::abs(potential(x))));
}

}  // namespace
}  // namespace pseudorigid::testing
