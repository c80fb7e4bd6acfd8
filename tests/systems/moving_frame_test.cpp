/// Motion of a point in a moving frame against the inertial frame, and the role of every inertial force (5.6.7).

#include "systems/moving_frame.h"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "mechanics/core/axial_vectors.h"
#include "support/integrate.h"
#include "systems/conservative_checks.h"

namespace pseudorigid::testing {

using systems::FrameMotion, systems::FrameParameters, systems::InertialFrame, systems::MovingFrame,
    systems::RelativeTerms;

/// A spin that speeds up about a tilted, precessing axis; an origin that falls and shakes.
FrameMotion generic_frame() {
  FrameMotion frame;
  frame.M0 = Eigen::AngleAxisd(0.7, Eigen::Vector3d(2, -1, 2) / 3).toRotationMatrix();
  frame.spin_axis = {1, 2, -2};
  frame.spin_rate = 0.8;
  frame.spin_acceleration = 0.05;
  frame.precession = {0.1, -0.3, 0.2};
  frame.origin = {0.3, -0.2, 0.1};
  frame.velocity = {0.1, 0.2, -0.1};
  frame.acceleration = {0.02, -0.01, 0.03};
  frame.shaking = {0.2, 0.1, -0.3};
  frame.shaking_frequency = 1.7;
  return frame;
}
FrameParameters with_every_force() {
  FrameParameters p{generic_frame(), {}};
  p.forces.field = {0.1, 0, -0.3};
  p.forces.center = {-0.4, 0.1, 0.2};
  p.forces.stiffness = 0.9;
  p.forces.frame_field = {0.1, 0.2, 0};
  p.forces.frame_center = {0.2, 0.4, -0.1};
  p.forces.frame_stiffness = {0.3, 0.5, 0.7};
  return p;
}
mechanics::State<MovingFrame> relative_start() { return {0, {1.0, 0.4, -0.3}, {-0.2, 0.5, 0.3}}; }

/// Largest distance of the two motions over [0, end], seen in the moving frame.
double disagreement(const FrameParameters& p, const mechanics::State<MovingFrame>& start, double end) {
  const MovingFrame moving(p);
  const InertialFrame inertial(p);
  const auto relative = integrate_samples(moving, start, end, 50, 1e-15);
  const auto absolute = integrate_samples(inertial, systems::to_inertial(p.frame, start), end, 50, 1e-15);
  double d = 0;
  for (std::size_t k = 0; k < relative.size(); ++k) {
    const auto s = systems::to_moving(p.frame, absolute[k]);
    d = std::max({d, (s.q - relative[k].q).norm(), (s.v - relative[k].v).norm()});
  }
  EXPECT_EQ(relative.size(), 51u);
  EXPECT_EQ(absolute.size(), 51u);
  return d;
}

/// "dM/dt = M(Ω ×)", and r and its derivatives belong together.
TEST(MovingFrame, DerivativesOfTheFrameAreThoseOfItsMotion) {
  const FrameMotion frame = generic_frame();
  const double t = 1.3;
  const auto pose = frame.at(t);
  const Eigen::Matrix3d M_rate = derivative([&](double s) { return frame.at(t + s).M; });
  const Eigen::Vector3d Omega_rate = derivative([&](double s) { return frame.at(t + s).Omega; });
  const Eigen::Vector3d r_rate = derivative([&](double s) { return frame.at(t + s).r; });
  const Eigen::Vector3d r_acceleration = derivative([&](double s) { return frame.at(t + s).r_rate; });
  EXPECT_LT((M_rate - pose.M * mechanics::cross_matrix(pose.Omega)).norm(), difference_tolerance);
  EXPECT_LT((Omega_rate - pose.Omega_rate).norm(), difference_tolerance);
  EXPECT_LT((r_rate - pose.r_rate).norm(), difference_tolerance);
  EXPECT_LT((r_acceleration - pose.r_acceleration).norm(), difference_tolerance);
}

TEST(MovingFrame, ChangeOfFrameAndBackIsTheIdentity) {
  auto s = relative_start();
  s.t = 2.1;
  const auto back = systems::to_moving(generic_frame(), systems::to_inertial(generic_frame(), s));
  EXPECT_LT((back.q - s.q).norm() + (back.v - s.v).norm(), 1e-15);
}

/// "The motion in a rotating coordinate system takes place as if three additional inertial forces acted" (5.6.7).
TEST(Statement_5_6_7, MotionInAMovingFrameIsTheInertialMotion) {
  EXPECT_LT(disagreement(with_every_force(), relative_start(), 20), 1e-11);
}

TEST(Statement_5_6_7, HoldsForKeplersMotionSeenFromARotatingFrame) {
  FrameParameters p{generic_frame(), {}};
  p.forces.attraction = 1.2;
  p.forces.center = {-0.4, 0.1, 0.2};
  EXPECT_LT(disagreement(p, {0, {1.0, 0.4, -0.3}, {-0.6, 0.9, 0.7}}, 10), 1e-11);
}

/// The relative motion without one of the inertial terms.
struct MovingFrameWithout {
  using Vector = Eigen::Vector3d;
  struct Workspace {};
  MovingFrame moving;
  Eigen::Vector3d RelativeTerms::*omitted;

  mechanics::Status acceleration(double t, const Vector& Q, const Vector& V, Workspace&, Vector& a) const {
    RelativeTerms terms;
    if (auto status = moving.terms(t, Q, V, terms); !status) return status;
    a = terms.sum() - terms.*omitted;
    return {};
  }
  Vector make_vector() const { return Vector::Zero(); }
  Workspace make_workspace() const { return {}; }
};

/// Each of the inertial forces is needed: without it the motion is another one.
TEST(Statement_5_6_7, NoInertialForceMayBeLeftOut) {
  const auto p = with_every_force();
  const MovingFrame moving(p);
  const auto right = integrate(moving, relative_start(), 5);
  for (const auto term :
       {&RelativeTerms::translation, &RelativeTerms::rotation, &RelativeTerms::coriolis, &RelativeTerms::centrifugal}) {
    const auto s = relative_start();
    const auto wrong = integrate(MovingFrameWithout{moving, term}, {s.t, s.q, s.v}, 5);
    EXPECT_GT((wrong.q - right.q).norm(), 0.01);
  }
}

/// A free point at rest in space, seen from a frame with constant Ω: Coriolis − 2Ω×Q̇ and centrifugal force leave the
/// circle |Q| = const, run through backwards.
TEST(MovingFrame, APointAtRestCirclesBackwards) {
  FrameParameters p;
  p.frame.spin_rate = 1.5;
  const auto start = systems::to_moving(p.frame, {0, {2, 0, 1}, {0, 0, 0}});
  const auto s = integrate(MovingFrame(p), start, 3.0, 1e-14);
  EXPECT_LT((s.q - Eigen::Vector3d(2 * std::cos(4.5), -2 * std::sin(4.5), 1)).norm(), 1e-12);
}

/// Foucault's pendulum: with frequency w, restoring force in the frame and Ω along the vertical, the plane of a swing
/// that is released at rest in the frame after half a turn of the frame is turned by −Ωt.
TEST(MovingFrame, FoucaultsPlaneTurnsBackWithTheRateOmega) {
  const double w = 20, rate = 0.05;
  FrameParameters p;
  p.frame.spin_rate = rate;
  p.forces.frame_stiffness = Eigen::Vector3d::Constant(w * w);
  // In space the isotropic oscillator has the period 2π/w: after whole periods the point is back at (1, 0, 0) in space
  // with its first velocity, and appears in the frame turned by −Ωt. The centre of the force is the origin.
  const double t = 2 * std::numbers::pi / w * 100;
  const auto s = integrate(MovingFrame(p), {0, {1, 0, 0}, {0, 0, 0}}, t, 1e-14);
  EXPECT_NEAR(std::atan2(s.q.y(), s.q.x()), -rate * t, 1e-10);
  EXPECT_GT(rate * t, 1.5);
}

/// With Ω constant and forces at rest in the frame, Jacobi's integral ½|Q̇|² + U − ½|Ω × Q|² is constant.
TEST(MovingFrame, JacobisIntegralIsConstant) {
  FrameParameters p;
  p.frame.spin_axis = {1, 2, 2};
  p.frame.spin_rate = 0.9;
  p.forces.frame_stiffness = {1.5, 2.5, 3.5};
  const auto integral = [&](const mechanics::State<MovingFrame>& s) {
    const Eigen::Vector3d Omega = p.frame.at(s.t).Omega;
    return 0.5 * s.v.squaredNorm() + 0.5 * s.q.dot(p.forces.frame_stiffness.cwiseProduct(s.q)) -
           0.5 * Omega.cross(s.q).squaredNorm();
  };
  const auto s = integrate(MovingFrame(p), relative_start(), 50, 1e-14);
  EXPECT_NEAR(integral(s), integral(relative_start()), 1e-11);
}

TEST(MovingFrame, APointInTheAttractingCentreIsAFailure) {
  FrameParameters p;
  p.forces.attraction = 1;
  const MovingFrame moving(p);
  auto w = moving.make_workspace();
  Eigen::Vector3d a;
  EXPECT_FALSE(moving.acceleration(0, Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones(), w, a));
}

}  // namespace pseudorigid::testing
