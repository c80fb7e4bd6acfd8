/// The planar double pendulum in multiplier form: derivatives, symmetry, angles, reactions, declared orders.

#include "systems/double_pendulum.h"

#include <gtest/gtest.h>

#include "mechanics/methods/methods.h"
#include "support/order_test.h"
#include "systems/conservative_checks.h"
#include "systems/sample_systems.h"

namespace pseudorigid::testing {

using systems::DoublePendulum;

const Eigen::Vector4d some_q(0.4, 0.9, -0.3, 1.7), other_q(0.5, 0.8, -0.1, 1.9), some_v(0.3, -0.8, 0.5, 0.7);
const Eigen::Vector2d some_multiplier(0.7, -1.9);

TEST(DoublePendulum, LawOfMotionIsConsistent) {
  const DoublePendulum pendulum(generic_pendulum);
  expect_energies_and_force_agree(pendulum, some_q, some_v);
  expect_constraint_derivatives_agree(pendulum, some_q, some_v, some_multiplier);
  expect_gram_solve_is_exact(pendulum, some_q, other_q, some_multiplier);
}

TEST(DoublePendulum, HasOneSymmetryWithoutGravityAndNoneWithIt) {
  auto p = generic_pendulum;
  EXPECT_EQ(DoublePendulum(p).n_symmetries(), 0);
  p.g = 0;
  EXPECT_EQ(DoublePendulum(p).n_symmetries(), 1);
  expect_symmetries_hold(DoublePendulum(p), some_q, some_v);
}

TEST(DoublePendulum, AnglesAndPositionsAreInverse) {
  const DoublePendulum pendulum(generic_pendulum);
  const Eigen::Vector2d angles(-2.9, 1.3), rates(0.7, -2.1);
  Eigen::Vector4d q, v;
  pendulum.from_angles(angles, rates, q, v);
  Eigen::Vector2d g, g_rate, angles_back, rates_back;
  ASSERT_TRUE(pendulum.constraint(q, g));
  pendulum.constraint_rate(q, v, g_rate);
  EXPECT_LT(g.norm(), 1e-15);
  EXPECT_LT(g_rate.norm(), 1e-15);
  pendulum.to_angles(q, v, angles_back, rates_back);
  EXPECT_LT((angles_back - angles).norm(), 1e-14);
  EXPECT_LT((rates_back - rates).norm(), 1e-14);
}

TEST(DoublePendulum, HangingAtRestTheRodsCarryTheWeights) {
  const DoublePendulum pendulum(generic_pendulum);
  mechanics::State<DoublePendulum> s{};
  pendulum.from_angles({0, 0}, {0, 0}, s.q, s.v);
  auto w = pendulum.make_workspace();
  auto lambda = pendulum.make_multiplier();
  ASSERT_TRUE(mechanics::multiplier_of_motion(pendulum, s, w, lambda));
  Eigen::Vector4d R = Eigen::Vector4d::Zero();
  pendulum.add_reaction(s.q, lambda, R);
  const auto& p = pendulum.parameters();
  EXPECT_LT((R - Eigen::Vector4d(0, -p.m1 * p.g, 0, -p.m2 * p.g)).norm(), 1e-15);
}

struct PendulumFactory {
  using System = DoublePendulum;
  DoublePendulum pendulum{generic_pendulum};
  const System& system() const { return pendulum; }
  mechanics::State<System> initial() const {
    mechanics::State<System> s{};
    pendulum.from_angles({1.4, -0.7}, {0.5, 1.0}, s.q, s.v);
    return s;
  }
  double end() const { return 4; }
  std::vector<long> step_counts(int order) const {
    if (order == 2) return {160, 320, 640, 1280, 2560};
    if (order == 4) return {40, 57, 80, 113, 160, 226};
    if (order == 6) return {40, 48, 57, 67, 80, 95};
    return {67, 73, 80, 87, 95, 113};
  }
  long n_reference_steps() const { return 400; }
};
using PendulumCases = OrderCases<PendulumFactory, OneStep>;
INSTANTIATE_TYPED_TEST_SUITE_P(DoublePendulum, MethodOrder, PendulumCases);

}  // namespace pseudorigid::testing
