/// n mass points: energies, forces, symmetries, dissipation, failures, declared orders.

#include "systems/mass_points.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mechanics/methods/methods.h"
#include "support/order_test.h"
#include "systems/conservative_checks.h"
#include "systems/sample_systems.h"

namespace pseudorigid::testing {

using systems::MassPoints;

MassPoints::Parameters points_with_every_force() {
  auto p = isolated_points();
  p.field = {0.1, -0.4, 0.7};
  p.center = {0.3, 0.2, -2.1};
  p.confinement = 0.6;
  p.central_attraction = 0.9;
  return p;
}

TEST(MassPoints, ForceIsTheGradientOfThePotential) {
  const auto s = four_points();
  expect_energies_and_force_agree(MassPoints(points_with_every_force()), s.q, s.v);
}

TEST(MassPoints, SymmetriesAreThoseThatTheExternalForcesLeave) {
  const auto s = four_points();
  const auto check = [&](const MassPoints::Parameters& p, int n_expected) {
    const MassPoints points(p);
    EXPECT_EQ(points.n_symmetries(), n_expected);
    expect_symmetries_hold(points, s.q, s.v);
  };
  auto p = isolated_points();
  check(p, 6);
  p.field = {0.1, -0.4, 0.7};
  check(p, 3);  // two translations across the field, the turn about it
  p.field.setZero();
  p.center = {0.3, 0.2, -2.1};
  p.central_attraction = 0.9;
  check(p, 3);  // turns about the centre
  p.confinement = 0.6;
  p.field = {0.1, -0.4, 0.7};
  check(p, 1);  // the turn about the line of the field through the centre
}

TEST(MassPoints, DragDampsAFreePointExponentially) {
  MassPoints::Parameters p;
  p.masses = Eigen::VectorXd::Constant(1, 2.0);
  p.drag = 0.3;
  const MassPoints point(p);
  mechanics::State<MassPoints> s{0, Eigen::Matrix3Xd::Zero(3, 1), Eigen::Matrix3Xd::Ones(3, 1)};
  ASSERT_TRUE(mechanics::velocity_dependent(point) && mechanics::dissipative(point));
  const auto r = run<mechanics::Rattle>(point, s, 4, 1, 4000);
  ASSERT_TRUE(r.finished());
  // Cayley's factor of order 2 with hγ/m = 1.5e-4: relative error t γ/m (hγ/m)²/12 = 1.1e-9.
  EXPECT_NEAR(r.last().v(0, 0), std::exp(-0.6), 1e-9);
}

TEST(MassPoints, DashpotsVanishOnRigidMotionsOnly) {
  auto p = isolated_points();
  p.gravitational_constant = 0;
  p.springs.clear();
  p.dashpots = {{0, 1, 0.8}, {1, 3, 0.5}, {0, 2, 1.1}};
  const MassPoints points(p);
  const auto s = four_points();
  auto w = points.make_workspace();
  Eigen::Matrix3Xd f = points.make_vector(), rigid = f;
  for (int i = 0; i < 4; ++i)
    rigid.col(i) = Eigen::Vector3d(0.3, -1, 2) + Eigen::Vector3d(1, 2, 3).cross(Eigen::Vector3d(s.q.col(i)));
  ASSERT_TRUE(points.force(0, s.q, rigid, w, f));
  EXPECT_LT(f.cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT(points.dissipated_power(s.q, rigid), 1e-28);

  ASSERT_TRUE(points.force(0, s.q, s.v, w, f));
  EXPECT_GT(points.dissipated_power(s.q, s.v), 0.1);
  EXPECT_NEAR(f.cwiseProduct(s.v).sum(), -points.dissipated_power(s.q, s.v), 1e-14) << "dE/dt = -P";
}

TEST(MassPoints, DissipatedPowerIsTheLossOfEnergy) {
  auto p = points_with_every_force();
  p.drag = 0.1;
  p.dashpots = {{0, 1, 0.8}, {1, 3, 0.5}};
  const MassPoints points(p);
  // dE/dt along a short step of RATTLE, by differences over ±h: error O(h²) of the method and of the difference.
  const auto s = four_points();
  const double h = 1e-4;
  const auto r = run<mechanics::Rattle>(points, s, 2 * h, 2, 1);
  ASSERT_TRUE(r.finished());
  const auto energy = [&](std::size_t k) {
    return points.kinetic_energy(r.states[k].v) + points.potential_energy(r.states[k].q);
  };
  const double slope = (energy(2) - energy(0)) / (2 * h);
  EXPECT_NEAR(slope, -points.dissipated_power(r.states[1].q, r.states[1].v), 1e-6);
}

TEST(MassPoints, PointsThatCoincideAreAFailureWithAReason) {
  auto s = four_points();
  s.q.col(0) = s.q.col(1);
  const MassPoints points(isolated_points());
  auto w = points.make_workspace();
  Eigen::Matrix3Xd f = points.make_vector();
  const auto status = points.force(0, s.q, s.v, w, f);
  EXPECT_FALSE(status);
  EXPECT_NE(status.reason().find("coincide"), std::string::npos);
}

struct PointsFactory {
  using System = MassPoints;
  MassPoints points{points_with_every_force()};
  const System& system() const { return points; }
  mechanics::State<System> initial() const { return four_points(); }
  double end() const { return 1; }
  std::vector<long> step_counts(int order) const {
    if (order == 2) return {160, 320, 640, 1280, 2560};
    if (order == 4) return {40, 57, 80, 113, 160, 226};
    if (order == 6) return {20, 24, 28, 34, 40, 48};
    return {12, 14, 17, 20, 24, 28};
  }
  long n_reference_steps() const { return 200; }
};
using PointsCases = OrderCases<PointsFactory, OneStep>;
INSTANTIATE_TYPED_TEST_SUITE_P(MassPoints, MethodOrder, PointsCases);

}  // namespace pseudorigid::testing
