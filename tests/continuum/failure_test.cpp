/// What goes wrong is a value: an inverted element and a number that is not one are a Status with the place. The step
/// that RATTLE tolerates is the one that the largest frequency of the ball predicts.

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "continuum/balls.h"
#include "mechanics/steps/largest_frequency.h"

namespace pseudorigid::testing {
namespace {

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Failure, HugeVelocityIsAStatusWithPlace) {
  const ElasticBall ball(octant, 3, 0, neo_hookean);
  const auto start = affine_state(ball, Matrix3d::Identity(), 60 * diagonal(1, 1, -2));
  const auto r = run<mechanics::Rattle>(ball, start, 1, 1, 100);  // one step turns the axis: 1 − 0.01·120 < 0
  EXPECT_EQ(r.result.outcome, mechanics::Outcome::failed);
  EXPECT_TRUE(contains(r.result.reason, "det F = -")) << r.result.reason;
  EXPECT_TRUE(contains(r.result.reason, "at X/r = (")) << r.result.reason;
}

/// Wherever in a cell, and so in the vectors of the kernels, the number that is not one stands.
TEST(Failure, NanInAPositionIsAStatus) {
  const ElasticBall ball(octant, 2, 0, neo_hookean);
  auto workspace = ball.make_workspace();
  const auto rest = affine_state(ball, Matrix3d::Identity(), Matrix3d::Zero());
  continuum::Vector f = ball.make_vector(), g = ball.make_multiplier();
  for (unsigned int i = 0; i < rest.q.size(); ++i) {
    auto x = rest.q;
    x[i] = std::numeric_limits<double>::quiet_NaN();
    const auto force = ball.force(0, x, rest.v, workspace, f);
    EXPECT_TRUE(contains(force.reason(), "det F = nan")) << i << force.reason();
    EXPECT_TRUE(contains(ball.constraint(x, g).reason(), "det F = nan")) << i;
  }
}

TEST(Failure, NanInAVelocityIsAStatus) {
  const ElasticBall ball(octant, 2, 0, neo_hookean);
  for (const unsigned int i : {10u, 100u}) {
    auto state = affine_state(ball, Matrix3d::Identity(), Matrix3d::Zero());
    mechanics::RattleWorkspace<ElasticBall> workspace(ball);
    state.v[i] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(mechanics::Rattle::project_velocity(ball, state, workspace));
  }
}

/// What a force refuses has no observables either, whether or not a multiplier is asked for.
TEST(Failure, ATurnedElementHasNoObservables) {
  const auto check = [](const auto& ball) {
    auto workspace = ball.make_workspace();
    auto state = affine_state(ball, Matrix3d::Identity(), Matrix3d::Zero());
    mechanics::ContinuumObservables o;
    mechanics::ObservableRequest request;
    request.multiplier = request.nonaffine = false;
    EXPECT_TRUE(observe(ball, state, workspace, request, o));
    state.q[3] += 0.7;  // a node
    continuum::Vector f = ball.make_vector();
    ASSERT_FALSE(ball.force(0, state.q, state.v, workspace, f));
    const auto status = observe(ball, state, workspace, request, o);
    EXPECT_TRUE(contains(status.reason(), "det F = -")) << status.reason();
  };
  check(CompressibleBall(octant, 3, 0, materials::SaintVenantKirchhoff{1, 1}));
  check(ElasticBall(octant, 3, 0, neo_hookean));
}

TEST(Failure, DegreeWithoutKernelsIsRefused) {
  EXPECT_THROW(ElasticBall(octant, 9, 0, neo_hookean), std::invalid_argument);
}

class Stability : public ::testing::TestWithParam<int> {
 protected:
  ElasticBall ball{octant, GetParam(), 0, neo_hookean};

  /// |v|_∞ after 400 steps of size h from small irregular velocities, relative to the largest one of the start.
  double growth(double h) {
    std::mt19937 generator(5);
    auto state = affine_state(ball, Matrix3d::Identity(), Matrix3d::Zero());
    state.v = random_field(state.v, generator);
    state.v *= 1e-9;
    ball.apply_inverse_mass(state.v, state.v);  // still irregular, and 0 on the planes
    mechanics::RattleWorkspace<ElasticBall> workspace(ball);
    EXPECT_TRUE(mechanics::Rattle::project_velocity(ball, state, workspace));
    const double at_start = state.v.linfty_norm();
    for (int i = 0; i < 400; ++i)
      if (!mechanics::Rattle::advance(ball, h, state, workspace)) return HUGE_VAL;
    return state.v.linfty_norm() / at_start;
  }
};

TEST_P(Stability, LimitIsThatOfTheLargestFrequency) {
  auto workspace = ball.make_workspace();
  const auto rest = affine_state(ball, Matrix3d::Identity(), Matrix3d::Zero());
  const auto report = mechanics::largest_frequency(ball, rest, workspace, 60);
  ASSERT_TRUE(report.status) << report.status.reason();
  RecordProperty("omega", std::to_string(report.omega));
  const double limit = mechanics::Rattle::stability_limit / report.omega;
  EXPECT_LT(growth(0.95 * limit), 20);
  EXPECT_GT(growth(1.05 * limit), 1e4);
}

INSTANTIATE_TEST_SUITE_P(Degree, Stability, ::testing::Values(2, 4));

}  // namespace
}  // namespace pseudorigid::testing
