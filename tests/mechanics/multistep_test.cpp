/// The explicit symmetric multistep methods.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "mechanics/core/explicit_multiplier.h"
#include "mechanics/core/memory.h"
#include "mechanics/method_cases.h"
#include "mechanics/methods/symmetric_multistep.h"
#include "support/integrate.h"
#include "support/order_fit.h"
#include "support/runs.h"

namespace pseudorigid::testing {
namespace {

using mechanics::ExplicitMultiplier;
using mechanics::State;
using mechanics::Symmetric12;
using mechanics::Symmetric4;
using mechanics::Symmetric8;

using Oscillation = Oscillator<10, 32>;
using Swing = Pendulum<10, 110>;
using LargePulsation = Pulsation<10, 320>;

template <class CaseType, class MethodType>
struct Pair {
  using Case = CaseType;
  using Method = MethodType;
};
template <class Pair>
class Multistep : public ::testing::Test {};
using Pairs =
    ::testing::Types<Pair<Oscillation, Symmetric4>, Pair<Swing, Symmetric4>, Pair<LargePulsation, Symmetric4>,
                     Pair<Oscillation, Symmetric8>, Pair<Swing, Symmetric8>, Pair<LargePulsation, Symmetric8>,
                     Pair<Oscillation, Symmetric12>, Pair<Swing, Symmetric12>, Pair<LargePulsation, Symmetric12>>;
TYPED_TEST_SUITE(Multistep, Pairs);

template <class Method, class S>
void advance(const S& system, double h, long n, State<S>& state, typename Method::template Workspace<S>& w) {
  for (long i = 0; i < n; ++i) {
    const auto status = Method::advance(system, h, state, w);
    ASSERT_TRUE(status) << status.reason();
  }
}

TYPED_TEST(Multistep, HasTheDeclaredOrder) {
  using Method = typename TypeParam::Method;
  const typename TypeParam::Case c;
  const auto exact = integrate(ExplicitMultiplier(c.system), c.initial(), c.end, 1e-15);
  std::vector<ErrorPoint> points;
  for (int n = c.coarsest; n <= 8 * c.coarsest; n += n / 5) {
    typename Method::template Workspace<typename TypeParam::Case::System> w(c.system);
    auto state = c.initial();
    advance<Method>(c.system, c.end / n, n, state, w);
    ASSERT_TRUE(Method::project_velocity(c.system, state, w));
    points.push_back({c.end / n, distance(state, exact)});
  }
  const auto fit = fit_order(points);
  EXPECT_GE(fit.n_used, 4u);
  EXPECT_GT(fit.order, 0.95 * Method::order);  // order 12 meets round-off while higher terms of its error are felt
}

TYPED_TEST(Multistep, StatesLieOnTheConstraint) {
  using Method = typename TypeParam::Method;
  const typename TypeParam::Case c;
  typename Method::template Workspace<typename TypeParam::Case::System> w(c.system);
  auto state = c.initial();
  auto r = c.system.make_multiplier();
  for (int i = 0; i < 200; ++i) {
    advance<Method>(c.system, c.end / (2 * c.coarsest), 1, state, w);
    ASSERT_TRUE(c.system.constraint(state.q, r));
    EXPECT_LE(mechanics::max_norm(r), 2e-15);  // some units of round-off
    ASSERT_TRUE(Method::project_velocity(c.system, state, w));
    c.system.constraint_rate(state.q, state.v, r);
    EXPECT_LE(mechanics::max_norm(r), 4e-15);
  }
}

/// The history backwards: q_{n−k+1} becomes the state, and the next steps go back.
template <class System>
void reverse(State<System>& state, Symmetric8::Workspace<System>& w) {
  const int m = w.n_slots;
  const auto at = [&](int i) { return (w.newest + m - i) % m; };  // slot of d_{n−i}, a_{n−i}
  auto d = w.d, a = w.a;
  for (int i = 0; i < m; ++i) state.q -= w.d[i];
  for (int i = 0; i < m; ++i) {
    d[at(i)] = -w.d[at(m - 1 - i)];
    if (i > 0) a[at(i)] = w.a[at(m - i)];
  }
  w.d = d;
  w.a = a;
  w.n_multipliers = 0;
  w.multipliers.fill({});
  w.acceleration_known = false;
}

/// Two parasitic roots are coupled by a motion whose frequency is the difference of their angles.
template <class Coefficients>
double first_resonance() {
  std::vector<double> angles;
  for (const long double a : Coefficients::a)
    for (const int sign : {-1, 1}) angles.push_back(sign * std::acos(static_cast<double>(a)));
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < angles.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, std::abs(angles[i] - angles[j]));
  return least;
}

TEST(SymmetricMultistep, KnowsItsFirstResonance) {
  EXPECT_NEAR(first_resonance<mechanics::Symmetric4Coefficients>(), Symmetric4::resonance_limit, 0.002);
  EXPECT_NEAR(first_resonance<mechanics::Symmetric8Coefficients>(), Symmetric8::resonance_limit, 0.001);
  EXPECT_NEAR(first_resonance<mechanics::Symmetric12Coefficients>(), Symmetric12::resonance_limit, 0.001);
}

TEST(SymmetricMultistep, IsReversible) {
  // 2000 steps there, the history turned round, and as many steps back: what is left is round-off, far below the error
  // of the method at this step (1e-6).
  const Swing c;
  Symmetric8::Workspace<SphericalPendulum> w(c.system);
  auto state = c.initial();
  const double h = 0.1;
  advance<Symmetric8>(c.system, h, 7, state, w);  // the start
  const auto first = state;
  advance<Symmetric8>(c.system, h, 2000, state, w);
  reverse(state, w);
  advance<Symmetric8>(c.system, h, 2000 - 7, state, w);
  EXPECT_LT((state.q - first.q).norm(), 1e-12);
}

TYPED_TEST(Multistep, EnergyDoesNotDrift) {
  // Some 10⁴ periods: the error of the second half is that of the first.
  using Method = typename TypeParam::Method;
  const typename TypeParam::Case c;
  typename Method::template Workspace<typename TypeParam::Case::System> w(c.system);
  auto state = c.initial();
  const double E = c.energy(state), h = c.end / (3.6 * c.coarsest);
  double mean[2] = {0, 0}, largest = 0;
  const int n_samples = 4000;
  for (int i = 0; i < n_samples; ++i) {
    advance<Method>(c.system, h, 101, state, w);
    ASSERT_TRUE(Method::project_velocity(c.system, state, w));
    const double error = c.energy(state) / E - 1;
    mean[2 * i / n_samples] += error / (n_samples / 2);
    largest = std::max(largest, std::abs(error));
  }
  EXPECT_LT(std::abs(mean[1] - mean[0]), 0.1 * largest + 1e-12);
}

TYPED_TEST(Multistep, MemoryContinuesBitByBit) {
  using Method = typename TypeParam::Method;
  using System = typename TypeParam::Case::System;
  const typename TypeParam::Case c;
  const double h = c.end / (2 * c.coarsest);
  for (const int n_before : {3, 50}) {  // within the start and after it
    typename Method::template Workspace<System> w(c.system), resumed(c.system);
    auto state = c.initial();
    advance<Method>(c.system, h, n_before, state, w);
    std::vector<double> memory;
    mechanics::save_memory(w, memory);
    ASSERT_TRUE(mechanics::restore_memory(resumed, memory));
    auto other = state;
    advance<Method>(c.system, h, 100, state, w);
    advance<Method>(c.system, h, 100, other, resumed);
    ASSERT_TRUE(Method::project_velocity(c.system, state, w));
    ASSERT_TRUE(Method::project_velocity(c.system, other, resumed));
    EXPECT_EQ(state.q, other.q);
    EXPECT_EQ(state.v, other.v);
  }
}

TYPED_TEST(Multistep, ChangedStepStartsAnew) {
  using Method = typename TypeParam::Method;
  const typename TypeParam::Case c;
  typename Method::template Workspace<typename TypeParam::Case::System> w(c.system);
  auto state = c.initial();
  const int n = 8 * c.coarsest;
  advance<Method>(c.system, c.end / n, n / 2, state, w);
  state.t = c.end / 2;
  advance<Method>(c.system, c.end / (2 * n), n, state, w);
  ASSERT_TRUE(Method::project_velocity(c.system, state, w));
  const auto exact = integrate(ExplicitMultiplier(c.system), c.initial(), c.end, 1e-15);
  // Not worse than the longer steps throughout.
  typename Method::template Workspace<typename TypeParam::Case::System> unchanged(c.system);
  auto with_long_steps = c.initial();
  advance<Method>(c.system, c.end / n, n, with_long_steps, unchanged);
  ASSERT_TRUE(Method::project_velocity(c.system, with_long_steps, unchanged));
  EXPECT_LT(distance(state, exact), distance(with_long_steps, exact) + 1e-11);
}

TEST(SymmetricMultistep, CoefficientsAreSymmetricAndOfTheirOrder) {
  const auto check = []<class Coefficients>(Coefficients) {
    constexpr int k = Coefficients::order;
    constexpr auto formula = mechanics::multistep_formula<k>(Coefficients::a);
    // ρ/(ζ − 1) changes its sign if read backwards, σ does not; sums of a few rounded numbers of order 10.
    EXPECT_NEAR(formula.difference[k - 2], 1, 1e-14);
    for (int i = 0; i < k - 2; ++i) EXPECT_NEAR(formula.difference[i], -formula.difference[k - 3 - i], 1e-14) << i;
    for (int i = 0; i < k - 1; ++i) EXPECT_EQ(formula.acceleration[i], formula.acceleration[k - 2 - i]) << i;
    // Exact for q = tˢ, s ≤ k + 1, about the middle of the formula: relative to its largest term.
    for (int s = 0; s <= k + 1; ++s) {
      const auto q = [&](int n) { return std::pow(n + 1 - k / 2, s); };
      const auto a = [&](int n) { return s < 2 ? 0 : s * (s - 1) * std::pow(n + 1 - k / 2, s - 2); };
      double error = q(k - 1) - q(k - 2), size = std::abs(q(k - 1)) + 1;
      for (int i = 0; i < k - 1; ++i) {
        const int n = k - 2 - i;
        error -= formula.difference[i] * (q(n) - q(n - 1)) + formula.acceleration[i] * a(n);
        size = std::max(size, std::abs(formula.acceleration[i] * a(n)));
      }
      EXPECT_NEAR(error / size, 0, 1e-14) << s;
    }
    // The velocity formula for q = tˢ at t = 0.
    for (int s = 0; s <= k + 1; ++s) {
      double v = s == 0 ? 0 : -std::pow(-1, s), size = 1;
      for (int i = 0; i < k && s >= 2; ++i) {
        const double term = formula.velocity[i] * s * (s - 1) * std::pow(-i, s - 2);
        v += term;
        size = std::max(size, std::abs(term));
      }
      EXPECT_NEAR(v / size, s == 1 ? 1 : 0, 1e-14) << s;
    }
  };
  check(mechanics::Symmetric4Coefficients{});
  check(mechanics::Symmetric8Coefficients{});
  check(mechanics::Symmetric12Coefficients{});
}

TYPED_TEST(Multistep, IsStableUpToItsLimit) {
  using Method = typename TypeParam::Method;
  const auto oscillator = harmonic_oscillator();
  typename Method::template Workspace<SpringNetwork> w(oscillator);
  auto state = Oscillation{}.initial();
  // Bounded, and no larger in the end than in the beginning; of high order, as the exact motion is.
  double largest[2] = {0, 0};
  const int n_steps = 100000;
  for (int i = 0; i < n_steps; ++i) {
    advance<Method>(oscillator, 0.98 * Method::stability_limit, 1, state, w);
    double& of_half = largest[2 * i / n_steps];
    of_half = std::max(of_half, std::abs(state.q[0]));
  }
  EXPECT_LT(largest[1], 1.01 * largest[0]);
  EXPECT_LT(largest[1], Method::order >= 8 ? 1.01 : 4);
}

/// A force that depends on the velocity.
struct Damped : SphericalPendulum {
  bool dissipative() const { return true; }
  bool velocity_dependent() const { return true; }
};

TEST(SymmetricMultistep, RefusesForcesThatAreNotConservative) {
  EXPECT_TRUE(Symmetric8::accepts(SphericalPendulum()));
  const auto status = Symmetric8::accepts(Damped());
  ASSERT_FALSE(status);
  EXPECT_NE(status.reason().find("conservative"), std::string::npos);
}

/// Also where every step is a sample, and its velocity is projected; the force of the last state is not made twice.
TEST(SymmetricMultistep, MakesOneForceAStep) {
  for (const long n_steps : {1, 10}) {
    const auto r = run<Symmetric8>(SphericalPendulum{}, SphericalPendulum::swinging(), 20, 1000 / n_steps, n_steps);
    ASSERT_TRUE(r.finished());
    EXPECT_EQ(r.counters.n_steps, 1000);
    EXPECT_LE(r.counters.n_force, r.counters.n_steps + 1);
  }
}

TEST(SymmetricMultistep, ForceThatBreaksOffIsReported) {
  for (const auto trouble : {SphericalPendulum::Trouble::failure, SphericalPendulum::Trouble::nan})
    for (const double from : {0.0, 0.15, 3.0}) {  // at the start, within it, after it
      const SphericalPendulum pendulum(trouble, from);
      Symmetric12::Workspace<SphericalPendulum> w(pendulum);
      auto state = SphericalPendulum::swinging();
      mechanics::Status status;
      for (int i = 0; i < 100 && status; ++i) status = Symmetric12::advance(pendulum, 0.05, state, w);
      EXPECT_FALSE(status);
      EXPECT_NEAR(state.t, from, 0.051);
      EXPECT_FALSE(status.reason().empty());
    }
}

}  // namespace
}  // namespace pseudorigid::testing
