/// Traits, reversibility, energy and failures of every method on small systems.

#include "mechanics/methods/methods.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mechanics/conservative_systems.h"
#include "support/method_lists.h"
#include "support/order_test.h"

namespace pseudorigid::testing {

struct PendulumFactory {
  using System = SphericalPendulum;
  SphericalPendulum pendulum;
  const System& system() const { return pendulum; }
  mechanics::State<System> initial() const { return SphericalPendulum::swinging(); }
  double end() const { return 4; }
  std::vector<long> step_counts(int order) const {
    if (order == 2) return {160, 320, 640, 1280, 2560};
    if (order == 4) return {40, 57, 80, 113, 160, 226};
    if (order == 6) return {40, 48, 57, 67, 80, 95};
    return {16, 20, 24, 28, 34, 40};
  }
  long n_reference_steps() const { return 200; }
};

template <class Method>
using PendulumCase = OrderCase<PendulumFactory, Method>;
using PendulumCases = CasesOf<PendulumCase, Symplectic>;
INSTANTIATE_TYPED_TEST_SUITE_P(Pendulum, MethodOrder, PendulumCases);

template <class Method>
class EveryMethod : public ::testing::Test {};
TYPED_TEST_SUITE(EveryMethod, Methods<All>);

template <class Method>
class FixedStepMethod : public ::testing::Test {};
TYPED_TEST_SUITE(FixedStepMethod, Methods<FixedStep>);

template <class Method>
class SymplecticMethod : public ::testing::Test {};
TYPED_TEST_SUITE(SymplecticMethod, Methods<Symplectic>);

/// |trace| of one step of the harmonic oscillator; the step is stable while it is at most 2.
template <class Method>
double trace_of_oscillator_step(double h) {
  const SpringNetwork oscillator = harmonic_oscillator();
  double trace = 0;
  for (const int column : {0, 1}) {
    mechanics::State<SpringNetwork> s{0, Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1)};
    (column == 0 ? s.q : s.v)(0) = 1;
    mechanics::RattleWorkspace<SpringNetwork> w(oscillator);
    EXPECT_TRUE(Method::advance(oscillator, h, s, w));
    trace += column == 0 ? s.q(0) : s.v(0);
  }
  return std::abs(trace);
}

TYPED_TEST(SymplecticMethod, StabilityLimitIsThatOfTheOscillator) {
  constexpr double increment = 1e-4;
  double h = increment;
  while (trace_of_oscillator_step<TypeParam>(h) <= 2 + 1e-12 && h < 10) h += increment;
  EXPECT_LE(TypeParam::stability_limit, h);
  EXPECT_GT(TypeParam::stability_limit, h - 0.01) << "the trait has two decimals, rounded down";
}

TYPED_TEST(SymplecticMethod, ReturnsWhereItCameFromWhenTimeIsReversed) {
  const SphericalPendulum pendulum;
  const auto there = run<TypeParam>(pendulum, SphericalPendulum::swinging(), 10, 1, 200);
  ASSERT_TRUE(there.finished());
  auto turned = there.last();
  turned.v = -turned.v;
  auto back = run<TypeParam>(pendulum, turned, 10, 1, 200).last();
  back.v = -back.v;
  EXPECT_GT(distance(there.last(), SphericalPendulum::swinging()), 0.1);
  EXPECT_LT(distance(back, SphericalPendulum::swinging()), 2e-13);
}

TYPED_TEST(SymplecticMethod, KeepsConstraintAndVerticalMomentumToRoundOff) {
  const SphericalPendulum pendulum;
  const auto start = SphericalPendulum::swinging();
  const auto r = run<TypeParam>(pendulum, start, 200, 400, 5);
  ASSERT_TRUE(r.finished());
  for (const auto& s : r.states) {
    EXPECT_LT(std::abs(s.q.squaredNorm() - 1), 4e-15);
    EXPECT_LT(std::abs(s.q.dot(s.v)), 4e-15);
    EXPECT_NEAR(s.q.cross(s.v).z(), start.q.cross(start.v).z(), 1e-13);
  }
}

TYPED_TEST(SymplecticMethod, EnergyErrorStaysBounded) {
  const SphericalPendulum pendulum;
  const auto start = SphericalPendulum::swinging();
  const auto r = run<TypeParam>(pendulum, start, 2000, 8000, 1);
  ASSERT_TRUE(r.finished());
  double early = 0, late = 0;
  for (std::size_t k = 0; k < r.states.size(); ++k) {
    double& largest = k < r.states.size() / 10 ? early : late;
    largest = std::max(largest, std::abs(SphericalPendulum::energy(r.states[k]) - SphericalPendulum::energy(start)));
  }
  EXPECT_LT(late, 1.3 * early + 1e-14);
  EXPECT_LT(late, 0.02);
}

TYPED_TEST(SymplecticMethod, CountsOneForceForEachStage) {
  const auto r = run<TypeParam>(SphericalPendulum{}, SphericalPendulum::swinging(), 1, 2, 10);
  EXPECT_EQ(r.counters.n_steps, 20);
  EXPECT_EQ(r.counters.n_substeps, 20 * TypeParam::n_stages);
  EXPECT_EQ(r.counters.n_force, 20 * TypeParam::n_stages + 1);
  EXPECT_EQ(r.counters.n_projections, 2);
}

TYPED_TEST(EveryMethod, StatesLieOnTheConstraint) {
  const ConservativePendulum pendulum;
  const auto start = SphericalPendulum::swinging();
  const auto r = run<TypeParam>(pendulum, start, 20, 40, 25);
  ASSERT_TRUE(r.finished()) << r.result.reason;
  ASSERT_EQ(r.states.size(), 41u);
  EXPECT_GT(distance(r.last(), start), 0.1);
  for (const auto& s : r.states) {
    EXPECT_LT(std::abs(s.q.squaredNorm() - 1), 4e-15);
    EXPECT_LT(std::abs(s.q.dot(s.v)), 4e-15);
  }
}

TYPED_TEST(EveryMethod, FollowsTheMotion) {
  const ConservativePendulum pendulum;
  const auto start = SphericalPendulum::swinging();
  const auto exact = run<mechanics::Rattle8>(pendulum, start, 4, 4, 100);
  const auto r = run<TypeParam>(pendulum, start, 4, 4, 100);
  ASSERT_TRUE(r.finished()) << r.result.reason;
  EXPECT_LT(distance(r, exact), TypeParam::order == 2 ? 1e-3 : 1e-7);
}

TYPED_TEST(EveryMethod, AForceThatFailsEndsTheRunWithItsReason) {
  const ConservativePendulum pendulum(SphericalPendulum::Trouble::failure, 1.2);
  const auto r = run<TypeParam>(pendulum, SphericalPendulum::swinging(), 4, 4, 10);
  EXPECT_EQ(r.result.outcome, mechanics::Outcome::failed);
  EXPECT_NE(r.result.reason.find("the rope is cut"), std::string::npos) << r.result.reason;
  EXPECT_EQ(r.states.size(), 2u) << "samples before the failure, none after";
}

TYPED_TEST(EveryMethod, ANaNDoesNotTravel) {
  const ConservativePendulum pendulum(SphericalPendulum::Trouble::nan, 1.2);
  const auto r = run<TypeParam>(pendulum, SphericalPendulum::swinging(), 4, 4, 10);
  EXPECT_EQ(r.result.outcome, mechanics::Outcome::failed);
  EXPECT_FALSE(r.result.reason.empty());
  EXPECT_EQ(r.states.size(), 2u);
  for (const auto& s : r.states) EXPECT_TRUE(s.q.allFinite() && s.v.allFinite());
}

/// More steps than a multistep method needs to start. A method that halves steps arrives nevertheless.
TYPED_TEST(FixedStepMethod, AStepFarTooLargeIsAFailure) {
  if constexpr (std::is_same_v<TypeParam, mechanics::Gauss16>) return;
  const auto r = run<TypeParam>(ConservativePendulum{}, SphericalPendulum::swinging(), 2000, 1, 20);
  EXPECT_EQ(r.result.outcome, mechanics::Outcome::failed);
  EXPECT_FALSE(r.result.reason.empty());
}

TEST(Methods, AreFoundByTheirNames) {
  mechanics::for_each_method([]<class Method>(Method) {
    EXPECT_EQ(mechanics::find_method(Method::name), mechanics::id_of<Method>);
    EXPECT_EQ(mechanics::method_name(mechanics::id_of<Method>), Method::name);
    EXPECT_EQ(mechanics::with_method(mechanics::id_of<Method>, [](auto m) { return m.order; }), Method::order);
  });
  EXPECT_FALSE(mechanics::find_method("rattle-5"));
}

}  // namespace pseudorigid::testing
