/// The explicit method of order 8 and the explicit multiplier.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "mechanics/core/explicit_multiplier.h"
#include "mechanics/core/memory.h"
#include "mechanics/method_cases.h"
#include "mechanics/methods/dormand_prince_8.h"
#include "support/integrate.h"
#include "support/order_fit.h"
#include "support/runs.h"

namespace pseudorigid::testing {
namespace {

using mechanics::DormandPrince8;
using mechanics::DormandPrince8Workspace;
using mechanics::ExplicitMultiplier;
using mechanics::State;

using ShortOscillation = Oscillator<5, 8>;
using ShortSwing = Pendulum<5, 24>;
using ShortPulsation = Pulsation<5, 40>;

template <class Case>
class ExplicitMethod : public ::testing::Test {};
using UnconstrainedCases = ::testing::Types<ShortOscillation, ShortSwing, ShortPulsation>;
TYPED_TEST_SUITE(ExplicitMethod, UnconstrainedCases);

/// n steps of one size, the error control left open; `visit` after each step.
template <class F, class Visit>
State<F> fixed_steps(const F& field, State<F> state, double end, int n, Visit&& visit) {
  DormandPrince8Workspace<F> w(field, 1e6);
  for (int i = 1; i <= n; ++i) {
    w.h = end / n;
    EXPECT_TRUE(DormandPrince8::step(field, end * i / n, state, w));
    visit(state, w);
  }
  return state;
}

TYPED_TEST(ExplicitMethod, HasOrder8) {
  const TypeParam c;
  const ExplicitMultiplier field(c.system);
  const auto exact = integrate(field, c.initial(), c.end, 1e-15);
  std::vector<ErrorPoint> points;
  for (int n = c.coarsest; n <= 10 * c.coarsest; n += n / 4) {
    const auto state = fixed_steps(field, c.initial(), c.end, n, [](auto&&...) {});
    points.push_back({c.end / n, distance(state, exact)});
  }
  const auto fit = fit_order(points);
  EXPECT_GE(fit.n_used, 4u);
  EXPECT_NEAR(fit.order, 8, 0.35);  // the steps are not small against the pulsation before round-off is met
}

TYPED_TEST(ExplicitMethod, DenseOutputHasOrder7) {
  // A polynomial of order 7 has errors of h⁸ between steps whose ends are right to h⁸.
  const TypeParam c;
  const ExplicitMultiplier field(c.system);
  const int n_times = 3000;  // so that the worst time of a step is met
  const auto exact = integrate_samples(field, c.initial(), c.end, n_times, 1e-15);
  std::vector<ErrorPoint> points;
  for (int n = c.coarsest; n <= 6 * c.coarsest; n += n / 2) {
    double error = 0;
    int next = 1;
    fixed_steps(field, c.initial(), c.end, n, [&](const auto& state, auto& w) {
      for (; next <= n_times && exact[next].t <= state.t; ++next) {
        auto between = state;
        EXPECT_TRUE(DormandPrince8::interpolate(field, exact[next].t, between, w));
        error = std::max(error, distance(between, exact[next]));
      }
    });
    EXPECT_EQ(next, n_times + 1);
    points.push_back({c.end / n, error});
  }
  const auto fit = fit_order(points);
  EXPECT_GE(fit.n_used, 4u);
  EXPECT_GT(fit.order, 7.4);
}

TYPED_TEST(ExplicitMethod, ErrorIsProportionalToTheTolerance) {
  const TypeParam c;
  const ExplicitMultiplier field(c.system);
  const auto exact = integrate(field, c.initial(), c.end, 1e-15);
  const auto ratio = [&](double tolerance) {
    return distance(integrate(field, c.initial(), c.end, tolerance), exact) / tolerance;
  };
  const double middle = ratio(1e-9);
  EXPECT_LT(middle, 100);
  for (const double tolerance : {1e-6, 1e-7, 1e-8, 1e-10, 1e-11, 1e-12}) {
    EXPECT_LT(ratio(tolerance), 8 * middle) << tolerance;  // not exactly: steps are whole numbers, errors have phases
    EXPECT_GT(ratio(tolerance), middle / 8) << tolerance;
  }
}

TYPED_TEST(ExplicitMethod, MotionCanBeRunBack) {
  const TypeParam c;
  const ExplicitMultiplier field(c.system);
  const auto there = integrate(field, c.initial(), c.end, 1e-12);
  EXPECT_LT(distance(integrate(field, there, 0.0, 1e-12), c.initial()), 1e-9);  // growth of two errors of 1e-12
}

TYPED_TEST(ExplicitMethod, StatesLieOnTheConstraint) {
  const TypeParam c;
  const ExplicitMultiplier field(c.system);
  auto r = c.system.make_multiplier();
  for (const auto& state : integrate_samples(field, c.initial(), c.end, 200, 1e-8)) {
    ASSERT_TRUE(c.system.constraint(state.q, r));
    EXPECT_LE(mechanics::max_norm(r), 2e-15);  // some units of round-off
    c.system.constraint_rate(state.q, state.v, r);
    EXPECT_LE(mechanics::max_norm(r), 4e-15);
  }
}

TYPED_TEST(ExplicitMethod, MemoryContinuesBitByBit) {
  const TypeParam c;
  using Field = ExplicitMultiplier<typename TypeParam::System>;
  const Field field(c.system);
  DormandPrince8Workspace<Field> w(field, 1e-10), resumed(field, 1e-10);
  auto state = c.initial();
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(DormandPrince8::step(field, c.end, state, w));
  std::vector<double> memory;
  mechanics::save_memory(w, memory);
  ASSERT_TRUE(mechanics::restore_memory(resumed, memory));
  auto other = state, between = state, other_between = state;
  const double t = w.t_start + 0.3 * w.h_last;
  ASSERT_TRUE(DormandPrince8::interpolate(field, t, between, w));
  ASSERT_TRUE(DormandPrince8::interpolate(field, t, other_between, resumed));
  EXPECT_EQ(between.q, other_between.q);
  while (state.t != c.end) {
    ASSERT_TRUE(DormandPrince8::step(field, c.end, state, w));
    ASSERT_TRUE(DormandPrince8::step(field, c.end, other, resumed));
    ASSERT_EQ(state.t, other.t);
    ASSERT_EQ(state.q, other.q);
    ASSERT_EQ(state.v, other.v);
  }
}

TEST(DormandPrince8Tableau, SatisfiesOrderConditions) {
  using namespace mechanics::dop853;
  const auto& b = a_exact[n_stages];
  // Row sums and quadrature, Σ_j a_ij = c_i and Σ_i b_i c_i^{s−1} = 1/s. The coefficients have 30 digits, sums of terms
  // up to 43 in long double 17.
  for (int i = 0; i < n_all_stages; ++i) {
    long double sum = 0;
    for (int j = 0; j < i; ++j) sum += a_exact[i][j];
    EXPECT_NEAR(static_cast<double>(sum - c_exact[i]), 0, 1e-16) << i;
  }
  for (int s = 1; s <= 8; ++s) {
    long double sum = 0;
    for (int i = 0; i < n_stages; ++i) sum += b[i] * std::pow(c_exact[i], s - 1.0L);
    EXPECT_NEAR(static_cast<double>(sum), 1.0 / s, 1e-16) << s;
  }
  // The tall trees, b aˢ⁻¹ 1 = 1/s!, and the simplifying assumption b̄_j = b_j(1 − c_j).
  std::array<long double, n_all_stages> power;
  power.fill(1);
  double factorial = 1;
  for (int s = 1; s <= 8; ++s) {
    factorial *= s;
    long double sum = 0;
    std::array<long double, n_all_stages> next{};
    for (int i = 0; i < n_stages; ++i) {
      sum += b[i] * power[i];
      for (int j = 0; j < i; ++j) next[i] += a_exact[i][j] * power[j];
    }
    EXPECT_NEAR(static_cast<double>(sum), 1 / factorial, 1e-16) << s;
    power = next;
  }
  for (int j = 0; j < n_stages; ++j)
    EXPECT_NEAR(Stage<n_stages>::x.q[j], static_cast<double>(b[j] * (1 - c_exact[j])), 1e-15) << j;
  // The error estimates vanish for polynomials of degree 4 and 2.
  const auto e3 = e3_exact();
  for (int s = 1; s <= 5; ++s) {
    long double sum5 = 0, sum3 = 0;
    for (int i = 0; i < n_stages; ++i) {
      sum5 += e5_exact[i] * std::pow(c_exact[i], s - 1.0L);
      sum3 += e3[i] * std::pow(c_exact[i], s - 1.0L);
    }
    EXPECT_NEAR(static_cast<double>(sum5), 0, 1e-15) << s;
    if (s <= 3) {
      EXPECT_NEAR(static_cast<double>(sum3), 0, 1e-15) << s;
    }
  }
}

TEST(DormandPrince8, BodyTurnedInsideOutCannotStart) {
  const ShortPulsation c;
  const ExplicitMultiplier field(c.system);
  DormandPrince8Workspace<ExplicitMultiplier<ShortPulsation::System>> w(field, 1e-10);
  auto state = c.initial();
  state.q(0, 0) = -1.3;
  const auto before = state;
  const auto status = DormandPrince8::step(field, 1, state, w);
  ASSERT_FALSE(status);
  EXPECT_NE(status.reason().find("cannot start"), std::string::npos) << status.reason();
  EXPECT_EQ(state.q, before.q);
}

TEST(DormandPrince8, ForceThatBreaksOffEndsTheMotionThere) {
  for (const auto trouble : {SphericalPendulum::Trouble::failure, SphericalPendulum::Trouble::nan}) {
    const SphericalPendulum pendulum(trouble, 2.0);
    const ExplicitMultiplier field(pendulum);
    DormandPrince8Workspace<ExplicitMultiplier<SphericalPendulum>> w(field, 1e-10);
    auto state = SphericalPendulum::swinging();
    mechanics::Status status;
    while (status && state.t < 5) status = DormandPrince8::step(field, 5, state, w);
    ASSERT_FALSE(status);
    EXPECT_NE(status.reason().find("cannot be continued"), std::string::npos) << status.reason();
    EXPECT_NEAR(state.t, 2, 1e-12);  // up to steps of round-off
    EXPECT_LE(state.t, 2);
    EXPECT_TRUE(state.q.allFinite() && state.v.allFinite());
  }
}

TEST(DormandPrince8, ToleranceBelowRoundOffIsRefused) {
  const ShortSwing c;
  const ExplicitMultiplier field(c.system);
  for (const double tolerance : {1e-17, 0.0, -1.0, std::nan("")}) {
    DormandPrince8Workspace<ExplicitMultiplier<SphericalPendulum>> w(field, tolerance);
    auto state = c.initial();
    EXPECT_FALSE(DormandPrince8::step(field, 1, state, w)) << tolerance;
  }
}

TEST(DormandPrince8, InterpolatesOnlyWithinTheLastStep) {
  const ShortSwing c;
  const ExplicitMultiplier field(c.system);
  DormandPrince8Workspace<ExplicitMultiplier<SphericalPendulum>> w(field, 1e-10);
  auto state = c.initial(), out = state;
  EXPECT_FALSE(DormandPrince8::interpolate(field, 0, out, w));
  ASSERT_TRUE(DormandPrince8::step(field, 5, state, w));
  EXPECT_FALSE(DormandPrince8::interpolate(field, 1.1 * state.t, out, w));
  ASSERT_TRUE(DormandPrince8::interpolate(field, state.t, out, w));
  EXPECT_LT(distance(out, state), 1e-15);
}

/// The explicit multiplier is that of `multiplier_of_motion`, for direct and for refined Gram solves.
template <class Case>
void expect_multiplier_of_motion(const Case& c) {
  using System = typename Case::System;
  const ExplicitMultiplier<System> field(c.system);
  const auto state = c.initial();
  auto w = field.make_workspace();
  auto a = c.system.make_vector(), expected = a;
  ASSERT_TRUE(field.acceleration(0, state.q, state.v, w, a));
  auto lambda = c.system.make_multiplier();
  ASSERT_TRUE(mechanics::multiplier_of_motion(c.system, state, w.system, lambda));
  ASSERT_TRUE(c.system.force(0, state.q, state.v, w.system, expected));
  c.system.add_reaction(state.q, lambda, expected);
  c.system.apply_inverse_mass(expected, expected);
  EXPECT_LT((a - expected).norm(), 1e-14 * (1 + expected.norm()));  // a few sums of numbers of order 1
}
struct ConstrainedSprings {
  using System = SpringNetwork;
  SpringNetwork system{Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(1, 2, 5).asDiagonal().toDenseMatrix(),
                       (Eigen::MatrixXd(2, 3) << 1, -1, 0, 0, 1, 2).finished()};
  State<SpringNetwork> initial() const { return {0, Eigen::Vector3d(2, 2, -1), Eigen::Vector3d(-2, -2, 1)}; }
};

TEST(ExplicitMultiplier, IsTheMultiplierOfTheMotion) {
  expect_multiplier_of_motion(ShortPulsation{});
  expect_multiplier_of_motion(ShortSwing{});
  expect_multiplier_of_motion(ConstrainedSprings{});
}

}  // namespace
}  // namespace pseudorigid::testing
