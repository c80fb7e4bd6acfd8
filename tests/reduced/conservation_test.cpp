/// What every method keeps on SL(3) and GL⁺(3): reversibility, det Q = 1, J, Z, energy without drift.

#include <gtest/gtest.h>

#include <algorithm>

#include "reduced/bodies.h"

namespace pseudorigid::testing {

template <class BodyType, class MethodType, bool incompressible>
struct Combination {
  using Body = BodyType;
  using Method = MethodType;
  static Body body() { return {Law{1, incompressible ? 0.0 : 1.0}, reduced::ReferenceBody::unit_ball()}; }
};

template <class C>
class Conservation : public ::testing::Test {};
using Combinations =
    ::testing::Types<Combination<Sl3, mechanics::Rattle, true>, Combination<Sl3, mechanics::Rattle4, true>,
                     Combination<Sl3, mechanics::Rattle6, true>, Combination<Sl3, mechanics::Rattle8, true>,
                     Combination<Gl3, mechanics::Rattle, false>, Combination<Gl3, mechanics::Rattle4, false>,
                     Combination<Gl3, mechanics::Rattle6, false>, Combination<Gl3, mechanics::Rattle8, false>>;
TYPED_TEST_SUITE(Conservation, Combinations);

/// Outer step of about equal reserve of stability for every method.
template <class Method>
constexpr double comfortable_step = Method::stability_limit * 0.04;

TYPED_TEST(Conservation, MotionIsReversible) {
  using Body = typename TypeParam::Body;
  const Body body = TypeParam::body();
  const auto start = benchmark_state<Body>();
  const auto there = run<typename TypeParam::Method>(body, start, 10, 1, 200);
  ASSERT_TRUE(there.finished());
  auto turned = there.last();
  turned.v = -turned.v;
  auto back = run<typename TypeParam::Method>(body, turned, 10, 1, 200).last();
  back.v = -back.v;
  EXPECT_GT(distance(there.last(), start), 0.1);
  EXPECT_LT(distance(back, start), 3e-13);
}

TYPED_TEST(Conservation, MomentumMapsAreKeptToRoundOff) {
  using Body = typename TypeParam::Body;
  const Body body = TypeParam::body();
  const auto start = benchmark_state<Body>();
  const auto before = observed(body, start);
  const auto r = run<typename TypeParam::Method>(body, start, 100, 200, 10);
  ASSERT_TRUE(r.finished());
  ASSERT_GT(before.angular_momentum.norm(), 0.1);
  for (const auto& s : r.states) {
    const auto o = observed(body, s);
    EXPECT_LT((o.angular_momentum - before.angular_momentum).norm(), 3e-13);
    EXPECT_LT((o.circulation - before.circulation).norm(), 3e-13);
  }
}

TYPED_TEST(Conservation, EnergyErrorIsBoundedAndDoesNotDrift) {
  using Method = typename TypeParam::Method;
  using Body = typename TypeParam::Body;
  const Body body = TypeParam::body();
  const auto start = benchmark_state<Body>();
  const double E0 = observed(body, start).energy();
  const auto r = run<Method>(body, start, 2000, 4000, static_cast<long>(std::ceil(0.5 / comfortable_step<Method>)));
  ASSERT_TRUE(r.finished());
  double early = 0, late = 0;
  for (std::size_t k = 0; k < r.states.size(); ++k) {
    const double error = std::abs(body.kinetic_energy(r.states[k].v) + body.potential_energy(r.states[k].q) - E0);
    double& largest = k < r.states.size() / 4 ? early : late;
    largest = std::max(largest, error);
  }
  EXPECT_LT(late, 1.2 * early + 1e-12);
  EXPECT_LT(late, 0.01 * E0);
}

TYPED_TEST(Conservation, AStepFarTooLargeIsAFailure) {
  using Body = typename TypeParam::Body;
  const auto r = run<typename TypeParam::Method>(TypeParam::body(), benchmark_state<Body>(), 2000, 1, 40);
  EXPECT_EQ(r.result.outcome, mechanics::Outcome::failed);
  EXPECT_FALSE(r.result.reason.empty());
  for (const auto& s : r.states) EXPECT_TRUE(s.q.allFinite() && s.v.allFinite());
}

template <class Method>
class Determinant : public ::testing::Test {};
using AllMethods = ::testing::Types<mechanics::Rattle, mechanics::Rattle4, mechanics::Rattle6, mechanics::Rattle8>;
TYPED_TEST_SUITE(Determinant, AllMethods);

TYPED_TEST(Determinant, DoesNotDriftInAHundredThousandSteps) {
  const auto r = run<TypeParam>(neo_hookean_sl3(), benchmark_state<Sl3>(), 2000, 1000, 100);
  ASSERT_TRUE(r.finished()) << r.result.reason;
  for (const auto& s : r.states) {
    ASSERT_LT(std::abs(s.q.determinant() - 1), 1e-14);
    ASSERT_LT(std::abs((s.q.inverse() * s.v).trace()), 1e-14);
  }
}

}  // namespace pseudorigid::testing
