/// The pseudo-rigid body on planes that move along their normals: Galilean invariance, the energy that planes give, a
/// ball that follows a plate, and the damping of a plane in motion.

#include <gtest/gtest.h>

#include <numbers>

#include "reduced/bodies_on_planes.h"
#include "support/differences.h"
#include "support/runs.h"

namespace pseudorigid::testing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using loads::Plane;
using Body = BodyOnPlanes;

loads::RigidPlanes oblique_plane(double damping, double friction) {
  return {.normals = {0.6, 0, 0.8},
          .points = {-0.6, 0, -0.8},
          .stiffness = 300,
          .damping = damping,
          .friction = friction,
          .slip_speed = 0.05};
}
StateOnPlanes thrown_and_turning(const Vector3d& velocity) {
  const Matrix3d turn = (Matrix3d() << 0, 0.2, 0.3, -0.2, 0, 0, -0.3, 0, 0).finished();
  return Body::state_of({0, Matrix3d::Identity(), turn}, Vector3d::Zero(), velocity);
}
TEST(PlaneMotion, HasTheSpeedOfItsPosition) {
  const Plane plane{.normal = Vector3d::UnitZ(), .position = -0.7, .speed = 0.3, .amplitude = 0.2, .frequency = 1.7};
  EXPECT_EQ(plane.at(0).position, -0.7);
  for (const double t : {0.0, 0.4, 3.1}) {
    const double slope = first_difference([&](int k) { return plane.at(t + 1e-2 * k).position; }, 1e-2);
    EXPECT_NEAR(plane.at(t).speed, slope, 1e-9);
    EXPECT_EQ(plane.stopped_at(t).position, plane.at(t).position);
    EXPECT_EQ(plane.stopped_at(t).speed, 0);
    EXPECT_EQ(plane.at(t).at(0), plane.at(t)) << "it is already at the time t";
  }
  EXPECT_TRUE(plane.moves());
  EXPECT_FALSE((Plane{.position = 1, .amplitude = 2}.moves())) << "without a frequency";
}

/// Loads depend on time if a plane moves, and only then.
TEST(PlaneMotion, MakesTheLoadsDependOnTime) {
  loads::RigidPlanes planes = oblique_plane(0, 0);
  EXPECT_FALSE(loads::depend_on_time(loads::Loads(planes)));
  EXPECT_TRUE(loads::angular_frequencies(loads::Loads(planes)).empty());
  planes.frequency = 2;
  EXPECT_FALSE(loads::depend_on_time(loads::Loads(planes)));
  planes.amplitudes = {0.1};
  EXPECT_TRUE(loads::depend_on_time(loads::Loads(planes)));
  EXPECT_EQ(loads::angular_frequencies(loads::Loads(planes)), std::vector<double>{2});
  planes.amplitudes = {0};
  planes.speeds = {0.1};
  EXPECT_TRUE(loads::depend_on_time(loads::Loads(planes)));
  EXPECT_TRUE(loads::angular_frequencies(loads::Loads(planes)).empty());
}

/// A plane with the speed u n that hits a ball, and a ball that flies with −u n against a plane at rest, are one motion
/// for two observers. With damping and friction as well: both depend on the relative velocity.
TEST(MovingPlane, IsAPlaneAtRestForAnotherObserver) {
  constexpr double u = 0.4, end = 3;
  const Vector3d n(0.6, 0, 0.8), velocity(0.1, 0.2, -0.1);
  for (const auto& [damping, friction] : {std::pair{0.0, 0.0}, std::pair{0.7, 0.0}, std::pair{0.7, 0.4}}) {
    loads::RigidPlanes planes = oblique_plane(damping, friction);
    const Body at_rest = ball_on(loads::Loads(planes));
    planes.speeds = {u};
    const Body moving = ball_on(loads::Loads(planes));
    const auto a = run<mechanics::Rattle>(at_rest, thrown_and_turning(velocity - u * n), end, 10, 300),
               b = run<mechanics::Rattle>(moving, thrown_and_turning(velocity), end, 10, 300);
    ASSERT_TRUE(a.finished() && b.finished());
    for (std::size_t k = 0; k < a.states.size(); ++k) {
      const StateOnPlanes &x = a.states[k], &y = b.states[k];
      EXPECT_LT((Body::matrix(x.q) - Body::matrix(y.q)).norm(), 1e-10);
      EXPECT_LT((Body::center(x.q) + u * x.t * n - Body::center(y.q)).norm(), 1e-10);
      EXPECT_LT((Body::center(x.v) + u * n - Body::center(y.v)).norm(), 1e-10);
      EXPECT_NEAR(at_rest.dissipated(x), moving.dissipated(y), 1e-10);
      EXPECT_NEAR(at_rest.contact(x.t, x.q).force, moving.contact(y.t, y.q).force, 1e-8);
    }
    EXPECT_GT(n.dot(Body::center(b.last().v)), u) << "it has been hit";
    EXPECT_TRUE(friction == 0 || moving.dissipated(b.last()) > 1e-2);
    EXPECT_NEAR(energy_of(moving, b.last()), energy_of(moving, b.states[0]), 1e-4);
  }
}

/// A plane that approaches another one compresses a ball slowly. The energy W that it gives is the energy of the body
/// and of the contact, and the force times the way of the plane.
TEST(MovingPlane, GivesTheWorkOfItsForce) {
  constexpr double u = 0.005, end = 40;
  const Body body = ball_on(loads::Loads(loads::RigidPlanes{
      .normals = {0, 0, 1, 0, 0, -1}, .points = {0, 0, -1, 0, 0, 1}, .stiffness = 50, .speeds = {u, 0}}));
  const auto r = run<mechanics::Rattle>(
      body, Body::state_of({0, Matrix3d::Identity(), Matrix3d::Zero()}, {0, 0, 0}, {0, 0, 0}), end, 2000, 4);
  ASSERT_TRUE(r.finished());
  double work = 0;
  for (std::size_t k = 0; k < r.states.size(); ++k) {
    const StateOnPlanes& s = r.states[k];
    EXPECT_NEAR(energy_of(body, s), 0, 1e-5);
    const double ends = k == 0 || k + 1 == r.states.size() ? 0.5 : 1;
    const loads::EllipsoidContact lower(Plane{.position = -1 + u * s.t, .stiffness = 50}, Matrix3d::Identity(),
                                        Body::matrix(s.q), Body::center(s.q));
    work += ends * lower.contact().force * u * end / 2000;
  }
  const double given = -body.driven_energy(r.last());
  EXPECT_GT(given, 1e-2);
  EXPECT_NEAR(given, work, 1e-4 * given);
}

/// A plate that shakes much slower than the ball pulsates carries the ball: the centre follows the plate.
TEST(MovingPlane, CarriesABall) {
  constexpr double g = 0.02, A = 0.05, Omega = 0.1;
  loads::RigidPlanes plate{.normals = {0, 0, 1}, .points = {0, 0, -1}, .stiffness = 100, .damping = 5};
  plate.amplitudes = {A};
  plate.frequency = Omega;
  const Body body = ball_on(loads::Loads(plate, loads::Acceleration{{0, 0, -g}}, loads::Viscosity{0.3}));
  StateOnPlanes start = Body::state_of({0, Matrix3d::Identity(), Matrix3d::Zero()}, {0, 0, 0}, {0, 0, A * Omega});
  start.q(2, 3) = -std::sqrt(4 * g / 300);
  const auto r = run<mechanics::Rattle>(body, start, 4 * std::numbers::pi / Omega, 200, 400);
  ASSERT_TRUE(r.finished());
  double least = 1, most = -1;
  for (std::size_t k = 100; k < r.states.size(); ++k) {  // after the ball has come to rest on the plate
    const StateOnPlanes& s = r.states[k];
    const double above = Body::center(s.q)[2] - A * std::sin(Omega * s.t);
    least = std::min(least, above);
    most = std::max(most, above);
    EXPECT_LT(body.contact(s.t, s.q).height, 0) << "it touches the plate";
  }
  EXPECT_LT(most - least, 0.02 * A) << "the depth follows the weight, which the plate changes by A Ω²/g = 2.5 %";
  EXPECT_NEAR(energy_of(body, r.last(), g), energy_of(body, r.states[0], g), 1e-3 * A);
}

/// The restitution of the velocities relative to the plane, which contact_watch.h uses, needs the speed of the plane.
TEST(MovingPlane, HasItsSpeedInTheSummaryOfTheContact) {
  loads::RigidPlanes planes = oblique_plane(0, 0);
  planes.speeds = {0.2};
  planes.amplitudes = {0.1};
  planes.frequency = 3;
  const Body body = ball_on(loads::Loads(planes));
  EXPECT_DOUBLE_EQ(body.contact(0, thrown_and_turning({0, 0, 0}).q).speed, 0.2 + 0.3);
  EXPECT_DOUBLE_EQ(body.contact(1, thrown_and_turning({0, 0, 0}).q).speed, 0.2 + 0.3 * std::cos(3));
  EXPECT_NEAR(body.contact(1, thrown_and_turning({0, 0, 0}).q).height, -(0.2 + 0.1 * std::sin(3)), 1e-15);
}

}  // namespace
}  // namespace pseudorigid::testing
