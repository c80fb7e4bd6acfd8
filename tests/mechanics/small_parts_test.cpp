/// Small parts of the methods by themselves: where they are wrong, the iterations behind them hide it.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "mechanics/conservative_systems.h"
#include "mechanics/core/central_difference.h"
#include "mechanics/core/small_cholesky.h"
#include "mechanics/equilibria/small_motion.h"
#include "mechanics/steps/step_size.h"
#include "support/runs.h"

namespace pseudorigid::testing {
namespace {

TEST(CentralDifference, IsOfOrderEight) {
  const auto F = [](double s, Eigen::VectorXd& value) {
    value = Eigen::VectorXd::Constant(1, std::sin(1 + s));
    return mechanics::Status();
  };
  Eigen::VectorXd coarse = Eigen::VectorXd::Zero(1), fine = coarse;
  ASSERT_TRUE(mechanics::central_difference(F, 0.4, coarse));
  ASSERT_TRUE(mechanics::central_difference(F, 0.2, fine));
  EXPECT_NEAR(fine[0], std::cos(1), 1e-8);
  EXPECT_NEAR(std::log2((coarse[0] - std::cos(1)) / (fine[0] - std::cos(1))), 8, 0.1);
}

TEST(CentralDifference, ReportsAFailureOnEitherSide) {
  for (const double side : {1.0, -1.0}) {
    const auto F = [&](double s, Eigen::VectorXd& value) {
      value = Eigen::VectorXd::Constant(1, s);
      return s * side > 0.25 ? mechanics::Status::failure("too far") : mechanics::Status();
    };
    Eigen::VectorXd derivative = Eigen::VectorXd::Zero(1);
    EXPECT_FALSE(mechanics::central_difference(F, 0.1, derivative));
    EXPECT_TRUE(mechanics::central_difference(F, 0.05, derivative));
  }
}

template <int n>
void expect_factor_of_size() {
  std::srand(n);
  const Eigen::Matrix<double, n, n> B = Eigen::Matrix<double, n, n>::Random();
  Eigen::Matrix<double, n, n> g = B * B.transpose();
  g.diagonal().array() += 0.1;
  const Eigen::Matrix<double, n, 1> x = Eigen::Matrix<double, n, 1>::Random();
  const mechanics::SmallCholesky<n> factor(g);
  ASSERT_TRUE(factor.regular());
  EXPECT_LT((factor.solve(g * x) - x).norm(), 1e-13) << n;
  g.col(n - 1).head(n - 1).setConstant(std::nan(""));  // the upper half is not read
  EXPECT_EQ(mechanics::SmallCholesky<n>(g).solve(x), factor.solve(x));
}

TEST(SmallCholesky, SolvesWithPositiveMatrices) {
  expect_factor_of_size<1>();
  expect_factor_of_size<2>();
  expect_factor_of_size<4>();
}

TEST(SmallCholesky, KnowsMatricesThatAreNotPositiveToRoundOff) {
  const auto regular = [](double a, double b, double c) {
    return mechanics::SmallCholesky<2>(Eigen::Matrix2d{{a, b}, {b, c}}).regular();
  };
  EXPECT_TRUE(regular(2, 1, 1));
  EXPECT_TRUE(regular(1e-300, 0, 1e-300));
  EXPECT_TRUE(regular(1, 0, 1e-15));
  EXPECT_FALSE(regular(1, 0, 1e-16));
  EXPECT_FALSE(regular(1, 1, 1));
  EXPECT_FALSE(regular(1, 2, 1));
  EXPECT_FALSE(regular(-1, 0, 1));
  EXPECT_FALSE(regular(1, std::nan(""), 1));
  EXPECT_FALSE(regular(HUGE_VAL, 0, 1));
}

TEST(MultiplierHistory, GuessesALineFromTheLastTwo) {
  mechanics::MultiplierHistory<SphericalPendulum> history{SphericalPendulum{}};
  double lambda = -1;
  history.record(0, 7);
  history.guess(3, lambda);
  EXPECT_EQ(lambda, 7);
  for (const double t : {1.0, 2.0, 2.5}) history.record(t, 3 - 2 * t);
  history.guess(3, lambda);
  EXPECT_NEAR(lambda, -3, 1e-15);
}

/// Iterations of the position solve for each substep.
template <class Method>
double iterations_per_substep(long n_steps) {
  const auto r = run<Method>(SphericalPendulum{}, SphericalPendulum::swinging(), 4, 1, n_steps);
  EXPECT_TRUE(r.finished());
  return static_cast<double>(r.counters.n_position_iterations) / static_cast<double>(r.counters.n_substeps);
}

/// Measured: 1.84, 1.40 and 1.51; without guesses 2.7, 2.4 and 2.4.
TEST(MultiplierHistory, SavesIterations) {
  EXPECT_LT(iterations_per_substep<mechanics::Rattle>(400), 2.1);
  EXPECT_LT(iterations_per_substep<mechanics::Rattle>(4000), 1.7);
  EXPECT_LT(iterations_per_substep<mechanics::Rattle8>(400), 1.8);
}

/// Two oscillators of frequencies 1 and 2 that a gyroscope of strength g couples: s⁴ + (5 + 4g²)s² + 4 = 0.
TEST(SmallMotion, IsTheOneWithTheNearestRate) {
  const double g = 0.7, b = 5 + 4 * g * g, root = std::sqrt(b * b - 16);
  Eigen::Matrix2d K, G;
  K << 1, 0, 0, 4;
  G << 0, -g, g, 0;
  for (const double exact : {std::sqrt((b - root) / 2), std::sqrt((b + root) / 2)}) {
    mechanics::SmallMotion motion;
    const auto status = mechanics::motion_near(K, G, {1e-3, exact + 2e-3}, motion);
    ASSERT_TRUE(status) << status.reason();
    EXPECT_NEAR(std::abs(motion.rate - std::complex<double>(0, exact)), 0, 1e-13);
    const auto s = motion.rate;
    EXPECT_LT(((s * s * Eigen::Matrix2cd::Identity() + 2.0 * s * G + K) * motion.shape).norm(), 1e-12);
    EXPECT_NEAR(motion.shape.norm(), 1, 1e-14);
  }
}

/// An unstable direction: s² = 1/4.
TEST(SmallMotion, MayGrow) {
  mechanics::SmallMotion motion;
  ASSERT_TRUE(mechanics::motion_near(Eigen::Vector2d(-0.25, 3).asDiagonal(), Eigen::Matrix2d::Zero(), 0.5, motion));
  EXPECT_NEAR(std::abs(motion.rate - 0.5), 0, 1e-13);
  EXPECT_NEAR(std::abs(motion.shape[0]), 1, 1e-12);
}

/// The largest component becomes real and positive, and the mean square becomes ε².
TEST(SmallMotion, HasItsAmplitudeAndPhase) {
  mechanics::PhaseDisplacements u = mechanics::PhaseDisplacements::Zero();
  u(1, 4) = {3, 4};
  u(2, 5) = {1, -1};
  const auto factor = mechanics::factor_of_shape(0.1, 9, u);
  EXPECT_NEAR(std::abs(factor), 0.1 / 3, 1e-15);
  EXPECT_NEAR((factor * u(1, 4)).imag(), 0, 1e-15);
  EXPECT_GT((factor * u(1, 4)).real(), 0);
}

/// Where the motion itself ends, no step helps: the search sees it from two pilot runs, and does not halve on.
TEST(StepSearch, GivesUpWhereTheMotionEnds) {
  const SphericalPendulum pendulum(SphericalPendulum::Trouble::failure, 1.2);
  const mechanics::StepRequest request{
      .end = 4, .window = 4, .tolerance = 1e-6, .rattle_limit = 0.02, .method = mechanics::id_of<mechanics::Rattle>};
  const auto choice = mechanics::choose_step(pendulum, SphericalPendulum::swinging(), request,
                                             [](const auto& state) { return state.q; });
  ASSERT_FALSE(choice.status);
  EXPECT_NE(choice.status.reason().find("the rope is cut"), std::string::npos) << choice.status.reason();
  EXPECT_LT(choice.n_force, 400);
}

/// The steps of the method that starts a multistep method say nothing of it: a window as short as these is made longer.
TEST(StepSearch, PilotsOfMultistepMethodsHoldStepsOfTheirOwn) {
  constexpr double end = 60;
  const SpringNetwork oscillator = harmonic_oscillator();
  const mechanics::State<SpringNetwork> start{0, Eigen::VectorXd::Ones(1), Eigen::VectorXd::Zero(1)};
  const auto check = [&]<class Method>(Method) {
    for (const double tolerance : {0.1, 3e-2, 1e-2, 1e-3}) {
      const mechanics::StepRequest request{.end = end,
                                           .window = 3 * Method::stability_limit,
                                           .tolerance = tolerance,
                                           .rattle_limit = mechanics::rattle_step_limit(1, 0),
                                           .method = mechanics::id_of<Method>};
      const auto choice = mechanics::choose_step(oscillator, start, request, [](const auto& state) { return state.q; });
      ASSERT_TRUE(choice.status) << choice.status.reason();
      const long n_steps = mechanics::SampleTimes{end, 1}.steps_per_interval(choice.step);
      const auto r = run<Method>(oscillator, start, end, 1, n_steps);
      ASSERT_TRUE(r.finished());
      const double error = std::abs(r.states.back().q[0] - std::cos(end));
      EXPECT_LE(error, tolerance) << choice.why;
      EXPECT_LE(error, 2 * choice.error) << choice.why;
    }
  };
  check(mechanics::Symmetric4());
  check(mechanics::Symmetric8());
  check(mechanics::Symmetric12());
}

}  // namespace
}  // namespace pseudorigid::testing
