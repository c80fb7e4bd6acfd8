/// Lagrange's equations for the motions of a rigid body, Oliva, Geometric Mechanics, (5.110)–(5.115), in Euler angles
/// (lagrange_top.h), beside Euler's equation and the constrained body.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/differences.h"
#include "support/integrate.h"
#include "systems/lagrange_top.h"
#include "systems/rigid_motions.h"

namespace pseudorigid::testing {
namespace {

using systems::EulerAngleChart, systems::LagrangeTop;
using TopByEuler = systems::EulerTop<systems::LoadTorque>;

Matrix3d tilted_inertia() { return systems::inertia_operator(tilted_E0()); }
const Vector3d some_angles_of_body(0.7, 1.1, -2.3);

/// The vectors ω_i of (5.112), ∂R/∂h_i R⁻¹ = ω_i×, by differences of the program's rotation.
Vector3d axis_of_angle(const Vector3d& h, int i) {
  const Matrix3d rate =
      first_difference([&](int k) { return LagrangeTop::rotation(h + 0.01 * k * Vector3d::Unit(i)); }, 0.01);
  return axial_of_skew(rate * LagrangeTop::rotation(h).transpose());
}

/// (5.112): the ω_i are e_z, the nodal line and e₃; R is that of the Euler angles of 5.6.20.
TEST(Statement_Eq5_112, AxesOfTheAngles) {
  const Vector3d& h = some_angles_of_body;
  const Matrix3d R = LagrangeTop::rotation(h);
  EXPECT_LT((R - systems::rotation_of({h[0], h[1], h[2]})).norm(), 1e-15);
  EXPECT_LT((axis_of_angle(h, 0) - Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_LT((axis_of_angle(h, 1) - Vector3d::UnitZ().cross(R.col(2)).normalized()).norm(), 1e-12);
  EXPECT_LT((axis_of_angle(h, 2) - R.col(2)).norm(), 1e-12);
}

/// (5.111), (5.113), (5.115): the force of the chart, −∂U/∂h_i, is (ω_i, ∫hBξ × df), weight and springs.
TEST(Statement_Eq5_115, ForcesAreTheMomentsAboutTheAxesOfTheAngles) {
  const auto loads = generic_loads();
  const LagrangeTop top(tilted_inertia(), loads);
  const Vector3d& h = some_angles_of_body;
  const Matrix3d R = LagrangeTop::rotation(h);
  Vector3d moment = Vector3d::Zero();
  ASSERT_TRUE(loads.apply([&](const Vector3d& xi) -> Vector3d { return R * xi; },
                          [&](const Vector3d& xi, const Vector3d& df) { moment += Vector3d(R * xi).cross(df); }));
  const Vector3d force = top.field().force(0, h, Vector3d::Zero());
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(force[i], axis_of_angle(h, i).dot(moment), 1e-12);
  EXPECT_GT(force.norm(), 0.5);
  EXPECT_NEAR(mechanics::potential_energy(top.field().chart(), h),
              loads.potential_energy([&](const Vector3d& xi) { return Vector3d(R * xi); }), 1e-14);
}

/// (5.115) along a motion of the constrained body: d/dt ∂K/∂ḣ_i − ∂K/∂h_i = −∂U/∂h_i with the angles of its rotation, K
/// and U of the chart; K is the body's.
TEST(Statement_Eq5_115, MotionsOfTheConstrainedBodyObeyLagrangesEquations) {
  const double h = 0.01;
  const FixedPointBody body({tilted_E0(), generic_loads()});
  const EulerAngleChart chart{tilted_inertia(), generic_loads()};
  const auto start = systems::turning(systems::rotation_of({0.7, 1.1, -2.3}), some_Omega);
  const auto r = run<mechanics::Rattle8>(body, start, 16 * h, 16, 2);
  ASSERT_TRUE(r.finished());
  const auto angles = [&](int k) {
    return LagrangeTop::turning(r.states[k].q, body.body_angular_velocity(r.states[k].q, r.states[k].v));
  };
  for (int k = 4; k <= 12; ++k) {
    const auto at = angles(k);
    EXPECT_NEAR(mechanics::kinetic_energy(chart, at.q, at.v), body.kinetic_energy(r.states[k].v), 1e-13);
    const Vector3d momentum_rate = first_difference(
        [&](int j) -> Vector3d {
          const auto s = angles(k + j);
          return mechanics::apply_mass(chart, s.q, s.v);
        },
        h);
    Vector3d slope;  // ∂(K − U)/∂h_i
    for (int i = 0; i < 3; ++i)
      slope[i] = first_difference(
          [&](int j) {
            const Vector3d q = at.q + 0.01 * j * Vector3d::Unit(i);
            return mechanics::kinetic_energy(chart, q, at.v) - mechanics::potential_energy(chart, q);
          },
          0.01);
    EXPECT_LT((momentum_rate - slope).norm(), 1e-9) << "round-off 1e-14/h and truncation h⁸";
  }
}

/// (5.114): "the first Lagrange equation gives m(S)r̈ = F", of a free body under weight and springs.
TEST(Statement_Eq5_114, CentreOfMassFollowsTheTotalForce) {
  const double h = 0.02;
  const auto body = loaded_free_body();
  const auto r = run<mechanics::Rattle8>(body, free_start(), 16 * h, 16, 4);
  ASSERT_TRUE(r.finished());
  for (int k = 4; k <= 12; ++k) {
    Vector3d F = Vector3d::Zero();
    const auto& s = r.states[k];
    ASSERT_TRUE(body.parameters().loads.apply([&](const Vector3d& xi) { return FreeBody::place(s.q, xi); },
                                              [&](const Vector3d&, const Vector3d& df) { F += df; }));
    const Vector3d rate = first_difference([&](int j) -> Vector3d { return r.states[k + j].v.col(3); }, h);
    EXPECT_LT((body.parameters().loads.mass * rate - F).norm(), 1e-10);
  }
}

/// The heavy symmetric top by three ways, Lagrange's and Euler's equations and the constrained body, over 100
/// revolutions away from the singularity: 1e-9.
TEST(Statement_Eq5_115, HeavyTopByThreeWays) {
  const HeavyTop parameters;
  const Matrix3d R = systems::rotation_of({0.2, 0.9, 0.4});
  const Vector3d Omega(0.3, -0.2, 6);
  const double end = 100 * 2 * std::numbers::pi / Omega.norm();
  const LagrangeTop lagrange(parameters.A(), parameters.loads());
  const auto in_angles = integrate(lagrange, LagrangeTop::turning(R, Omega), end, 1e-14);
  const auto by_euler = integrate(parameters.by_euler(), TopByEuler::turning(R, Omega), end, 1e-15);
  const auto constrained = run<mechanics::Rattle8>(parameters.body(), systems::turning(R, Omega), end, 100, 100);
  ASSERT_TRUE(constrained.finished()) << constrained.result.reason;
  const Matrix3d R_lagrange = LagrangeTop::rotation(in_angles.q);
  EXPECT_LT((R_lagrange - TopByEuler::rotation(by_euler.q)).norm(), 1e-9);
  EXPECT_LT((R_lagrange - constrained.last().q).norm(), 1e-9);
  EXPECT_LT((LagrangeTop::body_angular_velocity(in_angles.q, in_angles.v) -
             TopByEuler::body_angular_velocity(by_euler.q, by_euler.v))
                .norm(),
            1e-9);
  EXPECT_GT(std::abs(in_angles.q[2]), 500) << "the angle ψ has turned a hundred times";
}

/// Where e₃ comes to the vertical the chart ends with a sentence; the other forms go on.
TEST(LagrangeTop, EndsWithASentenceWhereTheChartIsSingular) {
  const Matrix3d A = generic_moments.asDiagonal();
  const LagrangeTop top(A, {});
  EXPECT_FALSE(LagrangeTop::has(Matrix3d::Identity()));
  auto w = top.make_workspace();
  Vector3d a;
  for (const double theta : {0.0, 1e-5, std::numbers::pi}) {
    const auto status = top.acceleration(0, {0.3, theta, 0.4}, {0, 0.1, 0}, w, a);
    ASSERT_FALSE(status);
    EXPECT_NE(status.reason().find("Euler angles are singular"), std::string::npos);
  }
  EXPECT_TRUE(top.acceleration(0, {0.3, 1e-3, 0.4}, {0, 0.1, 0}, w, a));
}

}  // namespace
}  // namespace pseudorigid::testing
