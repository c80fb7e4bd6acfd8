/// The stages of Gauss collocation of systems in lanes: the same as one after the other; sections of the motion by
/// systems behind an interface.

#include <gtest/gtest.h>

#include "mechanics/core/any_field.h"
#include "mechanics/core/any_system.h"
#include "mechanics/core/chart_field.h"
#include "mechanics/methods/gauss_16.h"
#include "support/runs.h"
#include "systems/double_pendulum.h"
#include "systems/double_pendulum_chart.h"
#include "systems/euler_top.h"
#include "systems/fixed_axis.h"
#include "systems/geodesic_scene.h"
#include "systems/lagrange_top.h"
#include "systems/mass_points.h"
#include "systems/moving_frame.h"
#include "systems/spherical_pendulum_scene.h"
#include "systems/torus.h"

namespace pseudorigid::testing {
namespace {

using mechanics::Gauss16;
using mechanics::State;

/// A system whose stages are not in lanes, since it does not say that they could be.
template <class S>
struct OneByOne {
  using Vector = typename S::Vector;
  using Workspace = typename mechanics::FieldOf<S>::Workspace;
  const S& system;
  mechanics::Status acceleration(double t, const Vector& q, const Vector& v, Workspace& w, Vector& a) const {
    return mechanics::field_of(system).acceleration(t, q, v, w, a);
  }
  Vector make_vector() const { return system.make_vector(); }
  Workspace make_workspace() const { return mechanics::field_of(system).make_workspace(); }
};

template <class S>
void expect_same_step(const S& system, const State<S>& start, double h) {
  ASSERT_TRUE(mechanics::has_stages_in_lanes(mechanics::field_of(system)));
  const OneByOne<S> slow{system};
  ASSERT_FALSE(mechanics::has_stages_in_lanes(slow));
  mechanics::Gauss16Workspace<S> w(system);
  mechanics::Gauss16Workspace<OneByOne<S>> of_slow(slow);
  auto a = start, b = start;
  for (int k = 0; k < 20; ++k) {
    ASSERT_TRUE(Gauss16::advance(system, h, a, w));
    ASSERT_TRUE(Gauss16::advance(slow, h, b, of_slow));
  }
  EXPECT_GT(distance(a, start), 0.1);
  EXPECT_LT(distance(a, b), 2e-13);
}

systems::DoublePendulum pendulum() { return systems::DoublePendulum({1.3, 0.7, 0.8, 1.1, 0.9}); }
State<systems::DoublePendulum> swinging_pendulum() {
  State<systems::DoublePendulum> start;
  pendulum().from_angles({0.6, 0.8}, {0.2, -0.3}, start.q, start.v);
  return start;
}

TEST(StagesOfSystems, OfTheDoublePendulumInBothForms) {
  expect_same_step(pendulum(), swinging_pendulum(), 0.1);
  const mechanics::ChartField angles(systems::DoublePendulumChart{1.3, 0.7, 0.8, 1.1, 0.9});
  expect_same_step(angles, {0, {0.6, 0.8}, {0.2, -0.3}}, 0.2);
}

TEST(StagesOfSystems, OfEulersTopUnderItsWeight) {
  using Top = systems::EulerTop<systems::LoadTorque>;
  Eigen::Matrix3d A;
  A << 1, 0.1, 0, 0.1, 2, 0.2, 0, 0.2, 2.5;
  const systems::BodyLoads loads{.mass = 1.2, .center = {0.1, -0.2, 0.3}, .gravity = {0.1, 0.2, -1}};
  const Eigen::Matrix3d R = Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const auto start = Top::turning(R, {0.4, 1, 0.6});
  expect_same_step(Top({.A = A, .torque = {loads}}), {0, start.q, start.v}, 0.2);
  systems::BodyLoads with_springs = loads;
  with_springs.springs = {{{1, 0, 0}, {2, 0, 0}, {1, 0.5}}, {{0, 0.5, 1}, {0, 1, -1}, {0.7, 0}}};
  expect_same_step(Top({.A = A, .torque = {with_springs}}), {0, start.q, start.v}, 0.1);
  const systems::LagrangeTop angles(A, with_springs);  // far from its poles
  const auto of_angles = systems::LagrangeTop::turning(
      Eigen::AngleAxisd(1.3, Eigen::Vector3d::UnitX()).toRotationMatrix(), {0.2, 0.3, 0.4});
  expect_same_step(angles, {0, of_angles.q, of_angles.v}, 0.05);
}

/// In principal axes, where the field is a shorter one, and in others.
TEST(StagesOfSystems, OfEulersTopWithoutWeight) {
  using Top = systems::EulerTop<>;
  Eigen::Matrix3d A;
  A << 1, 0.1, 0, 0.1, 2, 0.2, 0, 0.2, 2.5;
  const auto start = Top::turning(Eigen::Matrix3d::Identity(), {0.4, 1, 0.6});
  for (const Eigen::Matrix3d& inertia : {A, Eigen::Matrix3d(A.diagonal().asDiagonal())})
    expect_same_step(Top({.A = inertia}), {0, start.q, start.v}, 0.2);
}

/// J in space over 2·10⁵ steps. If |q|² is a sum of two halves, J changes by 4e-13, and term by term by 2e-14. For
/// three other starts it is 5e-14 at most. The bound was set after these measurements.
TEST(StagesOfSystems, DoNotTurnTheMomentumOfAFreeBody) {
  using Top = systems::EulerTop<>;
  const Top top({.A = Eigen::Vector3d(1, 2, 2.5).asDiagonal()});
  const auto start = Top::turning(Eigen::Matrix3d::Identity(), {0.4, 1, 0.6});
  const auto r = run<Gauss16>(top, start, 1e5, 1, 200'000);
  ASSERT_TRUE(r.finished());
  const auto J = [&](const auto& state) { return top.angular_momentum(state.q, state.v); };
  EXPECT_LT((J(r.last()) - J(start)).norm(), 1e-13);
}

TEST(StagesOfSystems, OfCharts) {
  const auto expect_same = [](const auto& chart, const auto& q, const auto& v, double h) {
    expect_same_step(mechanics::ChartField(chart), {0, q, v}, h);
  };
  const Eigen::Vector2d q(0.9, 0.4), v(0.3, -0.7);
  expect_same(systems::Torus{{3, 1, -1}, 0.8, 0.3, 0.2, 0.1, 0.2, 0.5, 0.4}, q, v, 0.2);
  expect_same(systems::TorusSurface{3, 1, 1}, q, v, 0.4);
  expect_same(systems::Sphere{1.2}, q, v, 0.2);
  expect_same(systems::Ellipsoid{1.3, 0.9, 0.6}, q, v, 0.2);
  expect_same(systems::Paraboloid{0.7}, q, v, 0.4);
  expect_same(systems::HyperbolicHalfPlane{}, q, v, 0.1);
  const systems::FixedAxis axis{
      {2, {0.3, 0.1, 0.2}, Eigen::Matrix3d::Identity()}, Eigen::Vector3d::UnitZ(), {0.4, -1, 0.3}, 0.2};
  expect_same(axis, systems::FixedAxis::Angle(0.4), systems::FixedAxis::Angle(1.1), 0.2);
}

/// Sines and cosines in lanes are those of moderate angles: after a million turns the stages are one after the other.
TEST(StagesOfSystems, OfAChartAfterManyTurns) {
  const double turns = std::exp2(20) * 2 * std::numbers::pi;
  const mechanics::ChartField torus(systems::TorusSurface{3, 1, 1});
  const Eigen::Vector2d v(0.3, -0.7);
  expect_same_step(torus, {0, Eigen::Vector2d(0.9, 0.4 + turns), v}, 0.4);
}

/// A chart that is derived from one with stages in lanes may have another field.
struct HeavySphere : systems::Sphere {
  template <class T>
  T potential(const mechanics::Coordinates<T, 2>& q) const {
    using std::cos;
    return T(2.0 * cos(q[0]));
  }
};
TEST(StagesOfSystems, NotOfADerivedChart) {
  EXPECT_TRUE(mechanics::has_stages_in_lanes(mechanics::ChartField(systems::Sphere{})));
  EXPECT_FALSE(mechanics::has_stages_in_lanes(mechanics::ChartField(HeavySphere{})));
}

/// A geodesic that runs into a pole: no step, and the reason of the field, which lanes do not know.
TEST(StagesOfSystems, WhereTheChartEnds) {
  using Field = systems::GeodesicScene::Field<systems::Sphere>;
  const Field field(systems::Sphere{});
  ASSERT_TRUE(mechanics::has_stages_in_lanes(field));
  State<Field> state{0, {0.33, 0}, {-1, 0}};
  mechanics::Gauss16Workspace<Field> w(field);
  mechanics::Status status;
  for (int k = 0; k < 10 && status; ++k) status = Gauss16::advance(field, 0.1, state, w);
  ASSERT_FALSE(status);
  EXPECT_NE(status.reason().find("pole"), std::string::npos) << status.reason();
}

TEST(StagesOfSystems, OfTheSphericalPendulum) {
  const systems::SphericalPendulum pendulum({1.3, 0.8, 0.9, 0.1});
  const double h = 0.1;
  expect_same_step(pendulum, {0, {0.48, 0, -0.64}, {0, 0.6, 0}}, h);
}

TEST(StagesOfSystems, OfMovingFrames) {
  const systems::FrameParameters p{
      .frame = {.M0 = Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix(),
                .spin_axis = {0.1, 0.2, 1},
                .spin_rate = 0.5,
                .spin_acceleration = 0.1,
                .precession = {0.1, 0, 0.2},
                .origin = {0.1, 0.2, 0.3},
                .velocity = {0.1, 0, 0},
                .acceleration = {0, 0.05, 0},
                .shaking = {0.1, 0.1, 0},
                .shaking_frequency = 1.5},
      .forces = {.field = {0, 0.1, -0.2},
                 .center = {3, 0, 0},
                 .stiffness = 0.3,
                 .attraction = 0.5,
                 .frame_field = {0.1, 0, 0},
                 .frame_center = {0, 0.2, 0},
                 .frame_stiffness = {0.2, 0.3, 0.4}}};
  expect_same_step(systems::MovingFrame(p), {0.3, {0.5, 0.4, 0.2}, {0.1, 0.2, -0.3}}, 0.1);
  expect_same_step(systems::InertialFrame(p), {0.3, {0.5, 0.4, 0.2}, {0.1, 0.2, -0.3}}, 0.1);
}

TEST(StagesOfSystems, OfMassPoints) {
  systems::MassPoints::Parameters p{.masses = Eigen::Vector3d(1, 0.5, 0.8),
                                    .gravitational_constant = 0.4,
                                    .springs = {{0, 1, {0.6, 0.8}}, {1, 2, {0.3, 0}}},
                                    .dashpots = {{0, 2, 0.1}},
                                    .field = {0, 0.1, -0.1},
                                    .center = {0.1, 3, 0},
                                    .confinement = 0.2,
                                    .central_attraction = 0.3,
                                    .drag = 0.05};
  Eigen::Matrix3Xd q(3, 3), v(3, 3);
  q << 1, -1, 0, 0.2, 0.1, 1.5, 0, 0.4, -0.3;
  v << 0, 0.3, -0.4, 0.5, -0.6, 0, 0.1, 0, 0.2;
  expect_same_step(systems::MassPoints(p), {0, q, v}, 0.1);
}

/// Points that coincide at the stages: no step, whatever pairs come after them, and the reason of the force. A dashpot
/// between them has no direction and no force.
TEST(StagesOfSystems, OfMassPointsThatCoincide) {
  systems::MassPoints::Parameters p{.masses = Eigen::Vector3d(1, 0.5, 0.8),
                                    .springs = {{0, 1, {0.6, 0.8}}, {1, 2, {0.3, 0}}}};
  State<systems::MassPoints> start{0, Eigen::Matrix3Xd::Zero(3, 3), Eigen::Matrix3Xd::Zero(3, 3)};
  start.q.col(2) = Eigen::Vector3d::UnitX();
  mechanics::GaussTables tables;
  tables.set_step(0.1);
  const auto in_lanes = [&](const systems::MassPoints& points, double& size) {
    std::vector<mechanics::OfStages> a(9), sums(9), scratch(9 * mechanics::GaussStages::n_scratch);
    mechanics::GaussStages stages{.n = 9,
                                  .h = 0.1,
                                  .q = start.q.data(),
                                  .v = start.v.data(),
                                  .tables = &tables,
                                  .outer_h = 0.1,
                                  .a = a.data(),
                                  .sums = sums.data(),
                                  .scratch = scratch.data()};
    EXPECT_TRUE(points.solve_stages_in_lanes(stages));
    size = 0;
    for (const auto& of_entry : a)
      for (const double x : of_entry) size = std::max(size, std::abs(x));
    return stages.converged;
  };
  double size = 0;
  EXPECT_FALSE(in_lanes(systems::MassPoints(p), size));
  std::swap(p.springs[0], p.springs[1]);
  const systems::MassPoints points(p);
  EXPECT_FALSE(in_lanes(points, size));
  mechanics::Gauss16Workspace<systems::MassPoints> w(points);
  const mechanics::Status status = Gauss16::advance(points, 0.1, start, w);
  ASSERT_FALSE(status);
  EXPECT_NE(status.reason().find("coincide"), std::string::npos) << status.reason();

  p.springs = {{1, 2, {0.3, 0}}};
  p.dashpots = {{0, 1, 0.1}};
  start.v.setZero();
  start.q.setZero();
  EXPECT_TRUE(in_lanes(systems::MassPoints(p), size));
  EXPECT_EQ(size, 0);
}

/// Behind one type: the same bits, and projected at the samples.
TEST(StagesOfSystems, BehindAnInterface) {
  const auto start = swinging_pendulum();
  const mechanics::AnySystem<mechanics::dynamic_constraints> any(pendulum());
  EXPECT_TRUE(any.has_stages_in_lanes());
  const auto own = run<Gauss16>(pendulum(), start, 10, 10, 10);
  const auto behind = run<Gauss16>(any, {0, Eigen::VectorXd(start.q), Eigen::VectorXd(start.v)}, 10, 10, 10);
  ASSERT_TRUE(own.finished() && behind.finished());
  EXPECT_LT((own.last().q - behind.last().q).norm(), 1e-13);
  EXPECT_LT((own.last().v - behind.last().v).norm(), 1e-13);
  const mechanics::AnyField field(mechanics::ChartField(systems::DoublePendulumChart{}));
  EXPECT_TRUE(field.has_stages_in_lanes());
}

}  // namespace
}  // namespace pseudorigid::testing
