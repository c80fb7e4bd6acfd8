/// What every method keeps on SL(3) and GL⁺(3): reversibility, det Q = 1, J, Z, energy without drift.

#include <gtest/gtest.h>

#include <algorithm>

#include "reduced/bodies.h"
#include "support/method_lists.h"

namespace pseudorigid::testing {

template <class BodyType, class MethodType, bool incompressible>
struct Combination {
  using Body = BodyType;
  using Method = MethodType;
  static Body body() { return {Law{1, incompressible ? 0.0 : 1.0}, reduced::ReferenceBody::unit_ball()}; }
};

template <class Method>
using OnSl3 = Combination<Sl3, Method, true>;
template <class Method>
using OnGl3 = Combination<Gl3, Method, false>;

template <class C>
class Conservation : public ::testing::Test {};
TYPED_TEST_SUITE_P(Conservation);

/// Outer step of about equal reserve of stability for every method.
template <class Method>
constexpr double comfortable_step = Method::stability_limit * 0.04;

TYPED_TEST_P(Conservation, MotionIsReversible) {
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

TYPED_TEST_P(Conservation, MomentumMapsAreKeptToRoundOff) {
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

TYPED_TEST_P(Conservation, EnergyErrorIsBoundedAndDoesNotDrift) {
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

TYPED_TEST_P(Conservation, AStepFarTooLargeIsAFailure) {
  using Body = typename TypeParam::Body;
  const auto r = run<typename TypeParam::Method>(TypeParam::body(), benchmark_state<Body>(), 2000, 1, 40);
  EXPECT_EQ(r.result.outcome, mechanics::Outcome::failed);
  EXPECT_FALSE(r.result.reason.empty());
  for (const auto& s : r.states) EXPECT_TRUE(s.q.allFinite() && s.v.allFinite());
}

REGISTER_TYPED_TEST_SUITE_P(Conservation, MotionIsReversible, MomentumMapsAreKeptToRoundOff,
                            EnergyErrorIsBoundedAndDoesNotDrift, AStepFarTooLargeIsAFailure);
using SymplecticOnSl3 = CasesOf<OnSl3, Symplectic>;
using SymplecticOnGl3 = CasesOf<OnGl3, Symplectic>;
INSTANTIATE_TYPED_TEST_SUITE_P(Sl3, Conservation, SymplecticOnSl3);
INSTANTIATE_TYPED_TEST_SUITE_P(Gl3, Conservation, SymplecticOnGl3);

/// What the methods that are not symplectic keep as well: to their error, where it is not to round-off.
template <class C>
class EveryMethod : public ::testing::Test {};
TYPED_TEST_SUITE_P(EveryMethod);

TYPED_TEST_P(EveryMethod, KeepsVolumeMomentaAndEnergy) {
  using Body = typename TypeParam::Body;
  const Body body = TypeParam::body();
  const auto start = benchmark_state<Body>();
  const auto before = observed(body, start);
  const auto r = run<typename TypeParam::Method>(body, start, 50, 100, 40);
  ASSERT_TRUE(r.finished()) << r.result.reason;
  EXPECT_GT(distance(r.last(), start), 0.1);
  const bool low_order = !TypeParam::Method::symplectic && TypeParam::Method::order == 4;
  const double momenta = low_order ? 1e-6 : 1e-9;
  for (const auto& s : r.states) {
    if constexpr (std::is_same_v<Body, Sl3>) {
      EXPECT_LT(std::abs(s.q.determinant() - 1), 1e-14);
      EXPECT_LT(std::abs((s.q.inverse() * s.v).trace()), 1e-14);
    }
    const auto o = observed(body, s);
    EXPECT_LT((o.angular_momentum - before.angular_momentum).norm(), momenta);
    EXPECT_LT((o.circulation - before.circulation).norm(), momenta);
    EXPECT_NEAR(o.energy(), before.energy(), (TypeParam::Method::order == 2 ? 1e-2 : 1e-5) * before.energy());
  }
}

REGISTER_TYPED_TEST_SUITE_P(EveryMethod, KeepsVolumeMomentaAndEnergy);
using AllOnSl3 = CasesOf<OnSl3, All>;
using AllOnGl3 = CasesOf<OnGl3, All>;
INSTANTIATE_TYPED_TEST_SUITE_P(Sl3, EveryMethod, AllOnSl3);
INSTANTIATE_TYPED_TEST_SUITE_P(Gl3, EveryMethod, AllOnGl3);

template <class Method>
class Determinant : public ::testing::Test {};
TYPED_TEST_SUITE(Determinant, Methods<Symplectic>);

TYPED_TEST(Determinant, DoesNotDriftInAHundredThousandSteps) {
  const auto r = run<TypeParam>(neo_hookean_sl3(), benchmark_state<Sl3>(), 2000, 1000, 100);
  ASSERT_TRUE(r.finished()) << r.result.reason;
  for (const auto& s : r.states) {
    ASSERT_LT(std::abs(s.q.determinant() - 1), 1e-14);
    ASSERT_LT(std::abs((s.q.inverse() * s.v).trace()), 1e-14);
  }
}

}  // namespace pseudorigid::testing
