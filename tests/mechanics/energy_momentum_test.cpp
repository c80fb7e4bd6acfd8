/// The conserving method on small systems: what it keeps, its order and those of its compositions, failures.

#include "mechanics/methods/energy_momentum.h"

#include <gtest/gtest.h>

#include "mechanics/conservative_systems.h"
#include "mechanics/core/memory.h"
#include "mechanics/methods/composition.h"
#include "support/conserved.h"
#include "support/order_test.h"
#include "systems/sample_systems.h"

namespace pseudorigid::testing {

using mechanics::EnergyMomentum;
using mechanics::State;
template <class Coefficients>
using Composed = mechanics::Composition<EnergyMomentum, Coefficients>;

TEST(EnergyMomentum, SphericalPendulumKeepsEnergyMomentumAndConstraint) {
  for (const double h : {0.01, 0.1, 0.4, 0.8})
    expect_everything_kept<EnergyMomentum>(ConservativePendulum{}, SphericalPendulum::swinging(), h, 3000);
}

TEST(EnergyMomentum, TwoConstraintsWithGravity) {
  const systems::DoublePendulum pendulum(generic_pendulum);
  for (const double h : {0.01, 0.1, 0.3}) expect_everything_kept<EnergyMomentum>(pendulum, swinging(pendulum), h, 3000);
}

TEST(EnergyMomentum, NumberOfConstraintsKnownAtRunTime) {
  for (const int n : {1, 2, 4}) {
    const ConservativeChain chain(n);
    for (const double h : {0.02, 0.1}) expect_everything_kept<EnergyMomentum>(chain, chain.leaning(), h, 1000);
  }
}

TEST(EnergyMomentum, FreePointsKeepMomentumAndAngularMomentum) {
  auto p = isolated_points();
  p.gravitational_constant = 0;  // close encounters need small steps
  p.springs.push_back({1, 2, {0.9, 0.6}});
  const systems::MassPoints points(p);
  ASSERT_EQ(points.n_symmetries(), 6);
  for (const double h : {0.01, 0.1, 0.3}) expect_everything_kept<EnergyMomentum>(points, four_points(), h, 2000);
}

TEST(EnergyMomentum, ConstrainedRigidBody) {
  const HeavyTop top;
  const auto body = top.body();
  State<systems::FixedPointBody> s{0, generic_rotation(), Eigen::Matrix3d::Zero()};
  s.v = mechanics::cross_matrix(Eigen::Vector3d(0.4, -0.6, 1.5)) * s.q;
  for (const double h : {0.02, 0.1}) expect_everything_kept<EnergyMomentum>(body, s, h, 2000);
}

/// RATTLE at the same step: what the tests above see is not in the nature of the systems.
TEST(EnergyMomentum, RattleDoesNotKeepTheEnergy) {
  const ConservativePendulum pendulum;
  const auto r = run<mechanics::Rattle>(pendulum, SphericalPendulum::swinging(), 40, 400, 1);
  EXPECT_GT(departures(pendulum, r.states).energy, 1e-4);
}

TEST(EnergyMomentum, ConicalPendulumStaysOnItsCircle) {  // a relative equilibrium: Ω² = 1/cos α
  const double alpha = 0.7, spin = std::sqrt(1 / std::cos(alpha));
  const Eigen::Vector3d q(std::sin(alpha), 0, -std::cos(alpha));
  const auto r = run<EnergyMomentum>(ConservativePendulum{}, {0, q, {0, spin * q.x(), 0}}, 200, 2000, 1);
  ASSERT_TRUE(r.finished()) << r.result.reason;
  const Departures d = departures(ConservativePendulum{}, r.states);
  EXPECT_LT(d.energy, 1e-13);
  EXPECT_LT(d.momenta, 1e-13);
  // The numerical circle is not the exact one: the heights differ by O(h²).
  for (const auto& s : r.states) ASSERT_NEAR(s.q.z(), q.z(), 0.01);
}

struct ConservingPendulumFactory {
  using System = ConservativePendulum;
  ConservativePendulum pendulum;
  const System& system() const { return pendulum; }
  State<System> initial() const { return SphericalPendulum::swinging(); }
  double end() const { return 4; }
  std::vector<long> step_counts(int order) const {
    if (order == 2) return {160, 320, 640, 1280};
    if (order == 4) return {80, 113, 160, 226};
    if (order == 6) return {48, 57, 67, 80, 95, 113};
    return {32, 36, 40, 44, 48};
  }
  long n_reference_steps() const { return 200; }
};
using ConservingPendulumCases = ::testing::Types<OrderCase<ConservingPendulumFactory, EnergyMomentum>,
                                                 OrderCase<ConservingPendulumFactory, Composed<mechanics::Suzuki4>>,
                                                 OrderCase<ConservingPendulumFactory, Composed<mechanics::KahanLi6>>,
                                                 OrderCase<ConservingPendulumFactory, Composed<mechanics::KahanLi8>>>;
INSTANTIATE_TYPED_TEST_SUITE_P(ConservingPendulum, MethodOrder, ConservingPendulumCases);

TEST(EnergyMomentum, ReturnsWhereItCameFromWhenTimeIsReversed) {
  const ConservativePendulum pendulum;
  const auto start = SphericalPendulum::swinging();
  const auto there = run<EnergyMomentum>(pendulum, start, 10, 1, 100);
  ASSERT_TRUE(there.finished());
  auto turned = there.last();
  turned.v = -turned.v;
  auto back = run<EnergyMomentum>(pendulum, turned, 10, 1, 100).last();
  back.v = -back.v;
  EXPECT_GT(distance(there.last(), start), 0.1);
  EXPECT_LT(distance(back, start), 5e-13);
}

/// A step of the harmonic oscillator converges at the largest hω that a search tries, and does not at 2.1. The system
/// is two points on a spring with 2k/m = 1.
TEST(EnergyMomentum, IterationConvergesUpToTheDeclaredLimit) {
  systems::MassPoints::Parameters p;
  p.masses = Eigen::Vector2d(2, 2);
  p.springs = {{0, 1, {1, 0}}};
  const systems::MassPoints pair(p);
  Eigen::Matrix3Xd q = Eigen::Matrix3Xd::Zero(3, 2), v = q;
  q(0, 0) = 1;
  v(1, 1) = 0.5;
  EXPECT_TRUE(run<EnergyMomentum>(pair, {0, q, v}, EnergyMomentum::stability_limit * 100, 100, 1).finished());
  EXPECT_FALSE(run<EnergyMomentum>(pair, {0, q, v}, 2.1 * 100, 100, 1).finished());
}

TEST(EnergyMomentum, AStepFarTooLargeFailsWithAdviceAndLeavesTheState) {
  const ConservativePendulum pendulum;
  State<ConservativePendulum> s = SphericalPendulum::swinging();
  const auto before = s;
  mechanics::EnergyMomentumWorkspace<ConservativePendulum> w(pendulum);
  const auto status = EnergyMomentum::advance(pendulum, 30, s, w);
  ASSERT_FALSE(status);
  EXPECT_NE(status.reason().find("smaller step"), std::string::npos) << status.reason();
  EXPECT_EQ(distance(s, before), 0);
}

TEST(EnergyMomentum, FailuresOfTheForceEndTheRunAndNaNsDoNotTravel) {
  using Trouble = SphericalPendulum::Trouble;
  for (const Trouble trouble : {Trouble::failure, Trouble::nan}) {
    const auto r = run<EnergyMomentum>(ConservativePendulum(trouble, 1.2), SphericalPendulum::swinging(), 4, 4, 10);
    EXPECT_EQ(r.result.outcome, mechanics::Outcome::failed);
    EXPECT_FALSE(r.result.reason.empty());
    EXPECT_EQ(r.states.size(), 2u);
    for (const auto& s : r.states) EXPECT_TRUE(s.q.allFinite() && s.v.allFinite());
  }
}

TEST(EnergyMomentum, ResumesBitByBitFromItsMemory) {
  const ConservativePendulum pendulum;
  State<ConservativePendulum> s = SphericalPendulum::swinging();
  mechanics::EnergyMomentumWorkspace<ConservativePendulum> w(pendulum), resumed(pendulum);
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(EnergyMomentum::advance(pendulum, 0.1, s, w));
  std::vector<double> memory;
  mechanics::save_memory(w, memory);
  ASSERT_TRUE(mechanics::restore_memory(resumed, memory));
  auto t = s;
  for (int i = 0; i < 50; ++i) {
    ASSERT_TRUE(EnergyMomentum::advance(pendulum, 0.1, s, w));
    ASSERT_TRUE(EnergyMomentum::advance(pendulum, 0.1, t, resumed));
  }
  EXPECT_EQ(distance(s, t), 0);
}

/// Refused by a method that keeps the energy: points with drag.
TEST(EnergyMomentum, RefusesDissipation) {
  auto p = isolated_points();
  EXPECT_TRUE(EnergyMomentum::accepts(systems::MassPoints(p)));
  p.drag = 0.1;
  const auto status = EnergyMomentum::accepts(systems::MassPoints(p));
  ASSERT_FALSE(status);
  EXPECT_NE(status.reason().find("energy"), std::string::npos);
}

}  // namespace pseudorigid::testing
