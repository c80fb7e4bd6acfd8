/// Gauss collocation: its coefficients, its order above round-off with every kind of force, symmetry, energy without
/// drift, halving of steps that do not converge, memory. Momenta and lanes: tests/reduced/gauss_stages_test.cpp.

#include "mechanics/methods/gauss_16.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mechanics/conservative_systems.h"
#include "mechanics/core/memory.h"
#include "support/order_fit.h"
#include "support/runs.h"

namespace pseudorigid::testing {
namespace {

using mechanics::Gauss16;
using mechanics::Status;
namespace gauss = mechanics::gauss;

constexpr double extended = 1e-18;

TEST(GaussCoefficients, IntegratePolynomialsExactly) {
  for (int k = 1; k <= 2 * gauss::n_stages; ++k) {
    long double sum = 0;
    for (int j = 0; j < gauss::n_stages; ++j) sum += gauss::b[j] * std::pow(gauss::c[j], k - 1.0L);
    EXPECT_NEAR(static_cast<double>(sum * k - 1), 0, extended) << k;
    if (k > gauss::n_stages) continue;
    for (int i = 0; i < gauss::n_stages; ++i) {
      long double up_to_i = 0;
      for (int j = 0; j < gauss::n_stages; ++j) up_to_i += gauss::a[i][j] * std::pow(gauss::c[j], k - 1.0L);
      EXPECT_NEAR(static_cast<double>(up_to_i * k - std::pow(gauss::c[i], static_cast<long double>(k))), 0, extended);
    }
  }
}

TEST(GaussCoefficients, AreSymplecticAndSymmetric) {
  for (int i = 0; i < gauss::n_stages; ++i)
    for (int j = 0; j < gauss::n_stages; ++j) {
      EXPECT_NEAR(
          static_cast<double>(gauss::b[i] * gauss::a[i][j] + gauss::b[j] * gauss::a[j][i] - gauss::b[i] * gauss::b[j]),
          0, extended);
      EXPECT_NEAR(static_cast<double>(gauss::a[i][j] + gauss::a[7 - i][7 - j] - gauss::b[j]), 0, extended);
    }
}

TEST(GaussCoefficients, LagrangePolynomialsAreThoseOfTheNodes) {
  for (int i = 0; i < gauss::n_stages; ++i) {
    const auto l = gauss::lagrange(gauss::c[i]);
    for (int j = 0; j < gauss::n_stages; ++j) EXPECT_NEAR(static_cast<double>(l[j]), i == j ? 1 : 0, 1e-17);
  }
}

/// Kepler's motion with the period 2π; q = (1 − e, 0) at the start.
struct Kepler {
  using Vector = Eigen::Vector2d;
  struct Workspace {};
  static constexpr double eccentricity = 0.3;

  Status acceleration(double, const Vector& q, const Vector&, Workspace&, Vector& a) const {
    a = -q / std::pow(q.norm(), 3);
    return {};
  }
  Vector make_vector() const { return Vector::Zero(); }
  Workspace make_workspace() const { return {}; }
  static mechanics::State<Kepler> start() {
    return {0, {1 - eccentricity, 0}, {0, std::sqrt((1 + eccentricity) / (1 - eccentricity))}};
  }
};

/// A force of position, velocity and time that lets q = cos 3t solve q̈ = −q³ − γq̇ + r(t).
struct DrivenAndDamped {
  using Vector = Eigen::Matrix<double, 1, 1>;
  struct Workspace {};
  static constexpr double rate = 3, damping = 0.4;

  static double solution(double t) { return std::cos(rate * t); }
  static double velocity(double t) { return -rate * std::sin(rate * t); }
  Status acceleration(double t, const Vector& q, const Vector& v, Workspace&, Vector& a) const {
    const double x = solution(t);
    a[0] = -std::pow(q[0], 3) - damping * v[0] + (-rate * rate * x + std::pow(x, 3) + damping * velocity(t));
    return {};
  }
  Vector make_vector() const { return Vector::Zero(); }
  Workspace make_workspace() const { return {}; }
  bool velocity_dependent() const { return true; }
  bool time_dependent() const { return true; }
  static mechanics::State<DrivenAndDamped> at(double t) { return {t, Vector(solution(t)), Vector(velocity(t))}; }
};

/// Errors above round-off, where every step is a whole one.
template <class Field>
OrderFit order_of(const mechanics::State<Field>& start, const mechanics::State<Field>& exact, double end,
                  std::initializer_list<long> step_counts) {
  std::vector<ErrorPoint> points;
  for (const long n : step_counts) {
    const auto r = run<Gauss16>(Field{}, start, end, 1, n);
    EXPECT_TRUE(r.finished()) << r.result.reason;
    EXPECT_EQ(r.counters.n_substeps, n) << "a step has been halved";
    points.push_back({end / static_cast<double>(n), distance(r.last(), exact)});
  }
  return fit_order(points);
}

TEST(Gauss16, HasOrder16OnKeplersMotion) {
  const auto fit = order_of<Kepler>(Kepler::start(), Kepler::start(), 2 * std::numbers::pi, {8, 9, 10, 11, 12, 14, 16});
  EXPECT_GE(fit.n_used, 4u);
  EXPECT_NEAR(fit.order, 16, 1.5);
}

TEST(Gauss16, HasOrder16WithVelocityAndTime) {
  const auto fit = order_of<DrivenAndDamped>(DrivenAndDamped::at(0), DrivenAndDamped::at(6), 6, {6, 7, 8, 9, 10, 12});
  EXPECT_GE(fit.n_used, 3u);
  EXPECT_NEAR(fit.order, 16, 1.5);
}

TEST(Gauss16, ReturnsWhereItCameFromWhenTimeIsReversed) {
  const SphericalPendulum pendulum;
  const auto there = run<Gauss16>(pendulum, SphericalPendulum::swinging(), 10, 1, 20);
  ASSERT_TRUE(there.finished());
  auto turned = there.last();
  turned.v = -turned.v;
  auto back = run<Gauss16>(pendulum, turned, 10, 1, 20).last();
  back.v = -back.v;
  EXPECT_GT(distance(there.last(), SphericalPendulum::swinging()), 0.1);
  EXPECT_LT(distance(back, SphericalPendulum::swinging()), 1e-12);
}

/// Sums in double precision would make both drift, here by 6e-18 a step and 1.2e-12 in all, and so would coefficients
/// rounded to it. The round-off that is left depends on the compiler's choices: 3e-14 to 1.1e-13 was seen.
TEST(Gauss16, EnergyAndMomentumDoNotDrift) {
  const auto energy = [](const auto& s) { return 0.5 * s.v.squaredNorm() - 1 / s.q.norm(); };
  const auto momentum = [](const auto& s) { return s.q[0] * s.v[1] - s.q[1] * s.v[0]; };
  const auto start = Kepler::start();
  const auto r = run<Gauss16>(Kepler{}, start, 80000, 200, 1000);
  ASSERT_TRUE(r.finished());
  for (const auto& s : r.states) {
    EXPECT_NEAR(energy(s), energy(start), 3e-13);
    EXPECT_NEAR(momentum(s), momentum(start), 3e-13);
  }
}

/// The round-off of the multiplier moves the energy by 1e-16 a unit of time, whatever the step.
TEST(Gauss16, EnergyOfAConstrainedSystemStaysNearRoundOff) {
  const SphericalPendulum pendulum;
  const auto start = SphericalPendulum::swinging();
  const auto r = run<Gauss16>(pendulum, start, 5000, 500, 25);
  ASSERT_TRUE(r.finished());
  for (const auto& s : r.states) EXPECT_NEAR(SphericalPendulum::energy(s), SphericalPendulum::energy(start), 2e-12);
}

/// Iterations on the stages of some steps converge to what has little to do with the motion.
TEST(Gauss16, AStepThatDoesNotResolveTheMotionIsHalvedWithoutATolerance) {
  const SphericalPendulum pendulum;
  const auto start = SphericalPendulum::swinging();
  for (const long n_steps : {5, 10, 20, 40, 80}) {
    const auto r = run<Gauss16>(pendulum, start, 100, 1, n_steps);
    ASSERT_TRUE(r.finished()) << r.result.reason;
    EXPECT_NEAR(SphericalPendulum::energy(r.last()), SphericalPendulum::energy(start), 0.01) << n_steps;
  }
}

/// As many halvings as the motion needs, and no step accepted that has not converged.
TEST(Gauss16, AStepFarTooLongIsHalved) {
  const auto start = Kepler::start();
  mechanics::Gauss16Workspace<Kepler> w(Kepler{});
  w.tolerance = 1e-8;
  auto state = start;
  ASSERT_TRUE(Gauss16::advance(Kepler{}, 20 * std::numbers::pi, state, w));
  EXPECT_GT(w.counters.n_substeps, 20);
  EXPECT_LT(distance(state, start), 1e-5);
  mechanics::Gauss16Workspace<Kepler> whole(Kepler{});
  whole.most_halvings = 0;
  state = start;
  EXPECT_FALSE(Gauss16::advance(Kepler{}, 20 * std::numbers::pi, state, whole));
}

/// With a tolerance steps are halved where their polynomial does not resolve the motion, forwards and backwards alike.
TEST(Gauss16, HalvesStepsForTheirError) {
  const auto steps_and_error = [](double tolerance) {
    mechanics::Gauss16Workspace<Kepler> w(Kepler{});
    w.tolerance = tolerance;
    auto state = Kepler::start();
    for (int k = 0; k < 6; ++k) EXPECT_TRUE(Gauss16::advance(Kepler{}, std::numbers::pi / 3, state, w));
    return std::pair(w.counters.n_substeps, distance(state, Kepler::start()));
  };
  const auto [n_coarse, coarse] = steps_and_error(mechanics::Gauss16Workspace<Kepler>::coarsest_tolerance);
  const auto [n_fine, fine] = steps_and_error(1e-9);
  EXPECT_GT(n_fine, n_coarse);
  EXPECT_GT(coarse, 1e-9);
  EXPECT_LT(fine, 1e-8);
}

TEST(Gauss16, ResumesBitByBit) {
  const SphericalPendulum pendulum;
  mechanics::Gauss16Workspace<SphericalPendulum> w(pendulum);
  auto state = SphericalPendulum::swinging();
  for (int k = 0; k < 41; ++k) ASSERT_TRUE(Gauss16::advance(pendulum, k % 7 == 3 ? 0.2 : 0.4, state, w));
  std::vector<double> memory;
  mechanics::save_memory(w, memory);
  mechanics::Gauss16Workspace<SphericalPendulum> other(pendulum);
  ASSERT_TRUE(mechanics::restore_memory(other, memory));
  auto resumed = state;
  for (int k = 0; k < 60; ++k) {
    ASSERT_TRUE(Gauss16::advance(pendulum, k % 5 == 1 ? 0.1 : 0.4, state, w));
    ASSERT_TRUE(Gauss16::advance(pendulum, k % 5 == 1 ? 0.1 : 0.4, resumed, other));
    ASSERT_EQ(distance(state, resumed), 0) << k;
  }
}

}  // namespace
}  // namespace pseudorigid::testing
