/// The example of docs/adding_a_system.md: its law of motion, a motion known exactly, orders, invariants, equilibria.

#include <gtest/gtest.h>

#include "mechanics/equilibria/critical_points.h"
#include "mechanics/methods/methods.h"
#include "support/conserved.h"
#include "support/order_test.h"
#include "systems/conservative_checks.h"
#include "systems/spherical_pendulum_scene.h"

namespace pseudorigid::testing {

using systems::SphericalPendulum;

constexpr SphericalPendulum::Parameters heavy{.m = 1.3, .l = 0.8, .g = 1.1}, damped{1.3, 0.8, 1.1, 0.3};
const Eigen::Vector3d some_q(0.4, -0.9, 0.3), other_q(0.5, -0.8, 0.1), some_v(0.3, -0.8, 0.5);

TEST(SphericalPendulum, LawOfMotionIsConsistent) {
  const SphericalPendulum pendulum(heavy);
  expect_energies_and_force_agree(pendulum, some_q, some_v);
  expect_constraint_derivatives_agree(pendulum, some_q, some_v, -1.9);
  expect_gram_solve_is_exact(pendulum, some_q, other_q, -1.9);
}

TEST(SphericalPendulum, HasTheSymmetriesThatGravityLeaves) {
  auto p = heavy;
  EXPECT_EQ(SphericalPendulum(p).n_symmetries(), 1);
  expect_symmetries_hold(SphericalPendulum(p), some_q, some_v);
  p.g = 0;
  EXPECT_EQ(SphericalPendulum(p).n_symmetries(), 3);
  expect_symmetries_hold(SphericalPendulum(p), some_q, some_v);
}

/// The rod at the angle θ from the downward vertical, turning at the given rates.
mechanics::State<SphericalPendulum> start(double theta, double theta_dot, double phi_dot) {
  systems::SphericalPendulumScene scene;
  scene.l = heavy.l;
  scene.angles = {theta, 0};
  scene.rates = {theta_dot, phi_dot};
  return scene.with_model([](const auto& model) { return model.initial; });
}

/// The conical pendulum: θ stays where φ̇² = g/(l cos θ).
TEST(SphericalPendulum, KeepsItsHeightOnACone) {
  const double theta = 0.7, phi_dot = std::sqrt(heavy.g / (heavy.l * std::cos(theta)));
  const auto r =
      run<mechanics::Rattle8>(SphericalPendulum(heavy), start(theta, 0, phi_dot), 5 * 2 * EIGEN_PI / phi_dot, 50, 20);
  ASSERT_TRUE(r.finished()) << r.result.reason;
  for (const auto& s : r.states) EXPECT_NEAR(s.q.z(), -heavy.l * std::cos(theta), 1e-12);
  EXPECT_LT(distance(r.last(), r.states.front()), 1e-12) << "after five turns: the error of 1000 steps at order 8";
}

struct PendulumFactory {
  using System = SphericalPendulum;
  SphericalPendulum pendulum{heavy};
  const System& system() const { return pendulum; }
  mechanics::State<System> initial() const { return start(1.2, 0.4, 0.9); }
  double end() const { return 4; }
  std::vector<long> step_counts(int order) const {
    if (order == 2) return {160, 320, 640, 1280, 2560};
    if (order == 4) return {40, 57, 80, 113, 160, 226};
    if (order == 6) return {40, 48, 57, 67, 80, 95};
    return {28, 34, 40, 48, 57, 67};
  }
  long n_reference_steps() const { return 400; }
};
using Cases = OrderCases<PendulumFactory, OneStep>;
INSTANTIATE_TYPED_TEST_SUITE_P(SphericalPendulum, MethodOrder, Cases);

TEST(SphericalPendulum, EnergyAndMomentumAreKeptAtAnyStep) {
  for (const double h : {0.01, 0.1, 0.3})
    expect_everything_kept<mechanics::EnergyMomentum>(SphericalPendulum(heavy), start(1.2, 0.4, 0.9), h, 200);
}

/// dE/dt = −c|v|² by quadrature over the samples (Simpson's rule, whose error at this spacing is about 1e-9).
TEST(SphericalPendulum, DragTakesItsPowerFromTheEnergy) {
  const SphericalPendulum pendulum(damped);
  const int n = 400;
  const double end = 4;
  const auto r = run<mechanics::Rattle>(pendulum, start(1.2, 0.4, 0.9), end, n, 100);
  ASSERT_TRUE(r.finished()) << r.result.reason;
  double work = 0;
  for (int k = 0; k <= n; ++k) {
    const double weight = k == 0 || k == n ? 1 : k % 2 ? 4 : 2;
    work += weight * end / n / 3 * damped.c * r.states[k].v.squaredNorm();
  }
  EXPECT_GT(work, 0.1);
  EXPECT_NEAR(energy(pendulum, r.last()) - energy(pendulum, r.states.front()), -work, 1e-7) << "RATTLE: h² = 1e-8";
}

TEST(SphericalPendulum, MethodsThatDragBreaksRefuseIt) {
  const SphericalPendulum free(heavy), resisted(damped);
  EXPECT_TRUE(mechanics::Rattle::accepts(resisted));
  EXPECT_FALSE(mechanics::Rattle4::accepts(resisted));
  EXPECT_FALSE(mechanics::EnergyMomentum::accepts(resisted));
  EXPECT_TRUE(mechanics::Rattle4::accepts(free));
  EXPECT_TRUE(mechanics::EnergyMomentum::accepts(free));
}

TEST(SphericalPendulum, HangsWithMorseIndex0AndStandsWith2) {
  const SphericalPendulum pendulum(heavy);
  mechanics::CriticalPoints found;
  const auto status = mechanics::find_critical_points(mechanics::ConstrainedLandscape(pendulum), {}, found);
  ASSERT_TRUE(status) << status.reason();
  ASSERT_EQ(found.points.size(), 2u);
  for (const int k : {0, 1}) {
    const auto& p = found.points[k];
    EXPECT_LT((p.q - (2 * k - 1) * heavy.l * Eigen::Vector3d::UnitZ()).norm(), 1e-10);
    EXPECT_EQ(p.morse_index, 2 * k);
    EXPECT_EQ(p.nullity, 0);
    for (const double square : p.hessian_eigenvalues)
      EXPECT_NEAR(square, (1 - 2 * k) * heavy.g / heavy.l, 1e-9) << "frequency g/l, by differences";
  }
}

}  // namespace pseudorigid::testing
