/// Long runs: small oscillations do not drift away (with the constraint J − 1 they do), angular momentum is
/// conserved to round-off and energy stays bounded on a tumbling, pulsating ball without symmetry.

#include <gtest/gtest.h>

#include <numbers>

#include "continuum/balls.h"

namespace pseudorigid::testing {
namespace {

struct Series {
  std::vector<mechanics::ContinuumObservables> samples;

  template <class Quantity>
  double range(const Quantity& quantity) const {
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (const auto& o : samples) {
      least = std::min(least, quantity(o));
      most = std::max(most, quantity(o));
    }
    return most - least;
  }
  /// Mean over the last quarter minus mean over the first one.
  template <class Quantity>
  double drift(const Quantity& quantity) const {
    const std::size_t n = samples.size() / 4;
    double difference = 0;
    for (std::size_t i = 0; i < n; ++i)
      difference += (quantity(samples[samples.size() - 1 - i]) - quantity(samples[i])) / static_cast<double>(n);
    return difference;
  }
};

template <class Method>
Series observed_run(const ElasticBall& ball, const State<ElasticBall>& start, double end, long n_samples,
                    long n_steps) {
  const auto r = run<Method>(ball, start, end, n_samples, n_steps);
  EXPECT_TRUE(r.finished()) << r.result.reason;
  Series series;
  for (const auto& state : r.states) series.samples.push_back(observed(ball, state, {{.multiplier = false}}));
  return series;
}

const auto energy = [](const mechanics::ContinuumObservables& o) { return o.energy(); };

template <class Method>
class LongTimeOf : public ::testing::Test {};
using LongTimeMethods = ::testing::Types<mechanics::Rattle, mechanics::Symmetric4>;
TYPED_TEST_SUITE(LongTimeOf, LongTimeMethods);

TYPED_TEST(LongTimeOf, SmallOscillationsDoNotDrift) {
  constexpr double epsilon = 1e-3, period = 2 * std::numbers::pi / 2.665622189236;  // PHYSICS 3
  const ElasticBall ball(octant, 4, 0, neo_hookean);
  const auto start = affine_state(ball, Matrix3d::Identity(), epsilon * diagonal(1, 1, -2));
  const Series series = observed_run<TypeParam>(ball, start, 100 * period, 1000, 20);
  double largest = 0, nonaffine = 0;
  for (const auto& o : series.samples) {
    largest = std::max(largest, std::abs(o.Q(2, 2) - 1));
    nonaffine = std::max(nonaffine, o.nonaffine_displacement);
  }
  // The sum of all modes' amplitudes, Σ 2ε f_k/x_k, bounds the linear response: 2ε · 0.36.
  EXPECT_LT(largest, 2 * epsilon * 0.365);
  EXPECT_GT(largest, 2 * epsilon * 0.33);
  EXPECT_LT(nonaffine, 0.25 * epsilon);
  EXPECT_LT(std::abs(series.drift([](const auto& o) { return o.nonaffine_displacement; })), 0.05 * nonaffine);
  const double E = series.samples.front().energy();
  EXPECT_LT(series.range(energy), 1e-3 * E);
  EXPECT_LT(std::abs(series.drift(energy)), 1e-5 * E);
}

/// Without symmetry, deforming and turning at finite amplitude.
State<ElasticBall> tumbling(const ElasticBall& ball) {
  Matrix3d L;
  L << 0.1, -0.5, 0.2, 0.4, -0.15, 0.3, -0.1, -0.2, 0.05;
  return affine_state(ball, Matrix3d::Identity(), L);
}

/// Over 10⁴ steps, angular momentum and energy without a drift; the momentum to round-off by RATTLE, and to the error
/// of the step by methods that are only symmetric.
template <class Method>
void expect_conservation(const ElasticBall& ball) {
  const Series series = observed_run<Method>(ball, tumbling(ball), 200, 500, 20);
  const auto& first = series.samples.front();
  double error = 0;
  for (const auto& o : series.samples) error = std::max(error, (o.angular_momentum - first.angular_momentum).norm());
  EXPECT_LT(error, (Method::symplectic ? 1e-12 : 1e-6) * first.angular_momentum.norm());
  const auto momentum = [](const mechanics::ContinuumObservables& o) { return o.angular_momentum.norm(); };
  EXPECT_LT(std::abs(series.drift(momentum)), 0.1 * error + 1e-12 * first.angular_momentum.norm());
  EXPECT_LT(series.range(energy), 5e-4 * first.kinetic);
  EXPECT_LT(std::abs(series.drift(energy)), 5e-5 * first.kinetic);
  EXPECT_GT(series.range([](const auto& o) { return o.kinetic; }), 0.1 * first.kinetic);
}

TYPED_TEST(LongTimeOf, TumblingBallConservesAngularMomentumAndEnergy) {
  expect_conservation<TypeParam>(ElasticBall(whole, 2, 0, neo_hookean));
}

/// γ = 5.
TYPED_TEST(LongTimeOf, GravitatingTumblingBallDoesSoAsWell) {
  loads::Loads loads;
  loads.get<loads::SelfGravity>().constant = 15 / (4 * std::numbers::pi);
  expect_conservation<TypeParam>(ElasticBall(whole, 2, 0, continuum::StoredEnergy(neo_hookean, 2.5), loads));
}

/// Circulation is conserved by the ball; its drift is the error of the mesh (PHYSICS 7.4), which falls with the degree.
TEST(LongTime, CirculationIsConservedUpToTheMesh) {
  const auto error = [](int degree) {
    const ElasticBall ball(whole, degree, 0, neo_hookean);
    const Series series = observed_run<mechanics::Rattle>(ball, tumbling(ball), 5, 25, 16);
    const auto& Z = series.samples.front().circulation;
    double worst = 0;
    for (const auto& o : series.samples) worst = std::max(worst, (o.circulation - Z).norm() / Z.norm());
    return worst;
  };
  const double errors[] = {error(2), error(3), error(4)};
  EXPECT_LT(errors[0], 2e-3);
  EXPECT_LT(errors[1], 0.2 * errors[0]);
  EXPECT_LT(errors[2], 0.1 * errors[1]);
}

}  // namespace
}  // namespace pseudorigid::testing
