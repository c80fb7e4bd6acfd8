/// Bodies with a fixed axis (Oliva, Geometric Mechanics, 5.6.10) and reactions by the second fundamental form (5.29),
/// against the sums of d'Alembert over mass points and against multipliers.

#include "systems/fixed_axis.h"

#include <gtest/gtest.h>

#include <vector>

#include "mechanics/core/chart_field.h"
#include "mechanics/core/explicit_multiplier.h"
#include "mechanics/core/second_fundamental_form.h"
#include "mechanics/equilibria/chart_landscape.h"
#include "mechanics/equilibria/critical_points.h"
#include "systems/double_pendulum.h"
#include "systems/sample_systems.h"

namespace pseudorigid::testing {
namespace {

using Eigen::Vector3d;
using systems::FixedAxis;
using systems::MassDistribution;
using systems::WeightedPoint;

const std::vector<WeightedPoint> some_points{
    {{0.5, 0.1, 0}, 0.7}, {{-0.3, 0.8, 0.2}, 0.4}, {{0, -0.6, 0.3}, 0.5}, {{0.1, 0, 0.9}, 0.4}};

FixedAxis some_rotor(double friction) {
  return {MassDistribution::of_points(some_points), Vector3d(0.3, -0.2, 1).normalized(), {0.4, -0.3, -2}, friction};
}

/// Both bearings give each mass point what its acceleration needs beyond its weight, and have no torque about the axis
/// beside the friction.
TEST(Statement_5_6_10, BearingsGiveEachMassPointItsAcceleration) {
  const double a = -0.4, b = 0.7, angle = 0.8, rate = 2.3;
  for (const double friction : {0.0, 0.3}) {
    const FixedAxis rotor = some_rotor(friction);
    const mechanics::ChartField field(rotor);
    auto workspace = field.make_workspace();
    FixedAxis::Angle acceleration = field.make_vector();
    ASSERT_TRUE(field.acceleration(0, FixedAxis::Angle(angle), FixedAxis::Angle(rate), workspace, acceleration));
    const Vector3d e = rotor.axis, omega = rate * e, omega_dot = acceleration[0] * e;
    const Eigen::Matrix3d R = rotor.rotation(angle);
    Vector3d force = Vector3d::Zero(), torque = Vector3d::Zero();
    for (const WeightedPoint& p : some_points) {
      const Vector3d x = R * p.xi;
      const Vector3d f = p.mass * (omega_dot.cross(x) + omega.cross(omega.cross(x)) - rotor.gravity);
      force += f;
      torque += x.cross(f);
    }
    const auto [first, second] = systems::bearing_forces(rotor, a, b, angle, rate, acceleration[0]);
    EXPECT_LT((R * (first + second) - force).norm(), 1e-14);
    const Vector3d by_bearings = a * e.cross(R * first) + b * e.cross(R * second);
    EXPECT_LT((by_bearings - friction * rate * e - torque).norm(), 1e-14);
    EXPECT_NEAR(second.dot(e), 0, 1e-15) << "the first bearing carries the force along the axis";
  }
}

/// About a principal axis through the centre of mass they feel the weight alone, at any speed; about others, forces
/// that grow with the square of the rate.
TEST(Statement_5_6_10, BearingsOfABalancedBodyFeelItsWeightAlone) {
  MassDistribution wheel{2, Vector3d::Zero(), systems::second_moment(Vector3d(1, 1.3, 2).asDiagonal())};
  const Vector3d weight(0, -3, 0);
  FixedAxis rotor{wheel, Vector3d::UnitZ(), weight, 0};
  for (const double rate : {0.0, 5.0, 500.0}) {
    const auto [first, second] = systems::bearing_forces(rotor, -1, 1, 0, rate, 0);
    EXPECT_LT((first - second).norm(), 1e-13);
    EXPECT_LT((first + second + 2 * weight).norm(), 1e-13);
  }
  rotor.axis = Vector3d(0.1, 0, 1).normalized();
  rotor.gravity.setZero();
  const auto slow = systems::bearing_forces(rotor, -1, 1, 0, 5, 0),
             fast = systems::bearing_forces(rotor, -1, 1, 0, 10, 0);
  EXPECT_GT(slow.first.norm(), 0.1);
  EXPECT_LT((fast.first - 4 * slow.first).norm(), 1e-12);
  EXPECT_LT((fast.first + fast.second).norm(), 1e-12) << "a couple";
}

/// Steiner (5.6.11): the pendulum that a body makes about an axis swings at ω² = mgd/(I_c + md²).
TEST(Statement_5_6_11, AHeavyBodySwingsAboutAParallelAxis) {
  const double m = 1.7, d = 0.6, g = 9.81, I_c = 0.3;
  const Vector3d G(0, -d, 0);
  const Eigen::Matrix3d E0 = systems::second_moment(I_c * Eigen::Matrix3d::Identity()) + m * G * G.transpose();
  const FixedAxis rotor{{m, G, E0}, Vector3d::UnitZ(), {0, -g, 0}, 0};
  EXPECT_NEAR(rotor.moment_of_inertia(), I_c + m * d * d, 1e-15);
  const mechanics::AnyLandscape landscape{mechanics::ChartLandscape<FixedAxis>(rotor)};
  mechanics::CriticalPoints found;
  ASSERT_TRUE(mechanics::find_equilibria(landscape, false, {.n_starts = 20}, found));
  ASSERT_EQ(found.points.size(), 2);
  for (const int k : {0, 1}) {
    EXPECT_EQ(found.points[k].morse_index, k) << "it hangs, or stands";
    EXPECT_NEAR(found.points[k].hessian_eigenvalues[0], (1 - 2 * k) * m * g * d / (I_c + m * d * d), 1e-12);
  }
}

/// R = μ[B(v, v) − (μ⁻¹F)^⊥] of the double pendulum, from positions as functions of the angles alone, is Gᵀλ.
TEST(Statement_Eq5_29, ReactionsOfTheDoublePendulumWithoutMultipliers) {
  const systems::DoublePendulum pendulum(generic_pendulum);
  const auto& p = pendulum.parameters();
  const Eigen::Vector2d angles(0.9, -1.7), rates(1.3, -0.8);
  mechanics::State<systems::DoublePendulum> state{};
  pendulum.from_angles(angles, rates, state.q, state.v);
  // Dφ and D²φ(q̇, q̇) by differences of order 2 of the positions along the angles, on a step with errors of 1e-8.
  const auto at = [&](const Eigen::Vector2d& x) {
    Eigen::Vector4d q, v;
    pendulum.from_angles(x, rates, q, v);
    return q;
  };
  const double h = 1e-4;
  Eigen::Matrix<double, 4, 2> tangents;
  for (int k = 0; k < 2; ++k)
    tangents.col(k) = (at(angles + h * Eigen::Vector2d::Unit(k)) - at(angles - h * Eigen::Vector2d::Unit(k))) / (2 * h);
  const Eigen::Vector4d second = (at(angles + h * rates) - 2 * at(angles) + at(angles - h * rates)) / (h * h);
  const Eigen::Vector4d R = mechanics::reaction_by_second_fundamental_form<4, 2>(
      tangents, second, {p.m1, p.m1, p.m2, p.m2}, {0, p.m1 * p.g, 0, p.m2 * p.g});
  Eigen::Vector2d lambda;
  systems::DoublePendulum::Workspace workspace;
  ASSERT_TRUE(mechanics::multiplier_of_motion(pendulum, state, workspace, lambda));
  Eigen::Vector4d by_multipliers = Eigen::Vector4d::Zero();
  pendulum.add_reaction(state.q, lambda, by_multipliers);
  EXPECT_LT((R - by_multipliers).norm(), 1e-6 * by_multipliers.norm());
  EXPECT_GT(by_multipliers.norm(), 1);
}

}  // namespace
}  // namespace pseudorigid::testing
