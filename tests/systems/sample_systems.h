#pragma once
/// Systems and states that the tests of this folder share: generic, of order 1, with no symmetry by accident.

#include <Eigen/Dense>

#include "systems/double_pendulum.h"
#include "systems/euler_top.h"
#include "systems/mass_points.h"
#include "systems/rigid_body.h"

namespace pseudorigid::testing {

/// Four points that attract each other and are joined by two springs.
inline systems::MassPoints::Parameters isolated_points() {
  systems::MassPoints::Parameters p;
  p.masses = Eigen::Vector4d(1.0, 1.7, 0.6, 2.3);
  p.gravitational_constant = 0.4;
  p.springs = {{0, 1, {1.3, 0.8}}, {2, 3, {0.7, 1.5}}};
  return p;
}
inline mechanics::State<systems::MassPoints> four_points() {
  Eigen::Matrix3Xd q(3, 4), v(3, 4);
  q << 1.0, -0.4, 0.2, -1.1, 0.3, 1.2, -1.4, -0.2, 0.1, -0.3, 0.5, 0.9;
  v << 0.2, -0.5, 0.3, 0.1, 0.6, 0.1, -0.2, -0.4, -0.3, 0.4, 0.2, -0.1;
  return {0, q, v};
}

inline constexpr systems::DoublePendulum::Parameters generic_pendulum{
    .m1 = 1.3, .m2 = 0.7, .l1 = 0.9, .l2 = 1.2, .g = 1.1};
/// A motion of the pendulum at a low energy, where it is quasi-periodic to the eye and errors grow slowly.
inline mechanics::State<systems::DoublePendulum> swinging(const systems::DoublePendulum& pendulum) {
  mechanics::State<systems::DoublePendulum> s{};
  pendulum.from_angles({0.6, 0.4}, {-0.1, 0.3}, s.q, s.v);
  return s;
}

/// Principal moments of inertia 2, 3, 4 about the axes of K.
inline const Eigen::Vector3d generic_moments{2, 3, 4};
inline Eigen::Matrix3d generic_E0() { return systems::second_moment(generic_moments.asDiagonal()); }
/// E₀ with no principal axis along an axis of K.
inline Eigen::Matrix3d tilted_E0() {
  return (Eigen::Matrix3d() << 1.2, 0.2, -0.1, 0.2, 0.9, 0.15, -0.1, 0.15, 1.6).finished();
}
inline Eigen::Matrix3d generic_rotation() {
  return Eigen::AngleAxisd(0.9, Eigen::Vector3d(1, -2, 2).normalized()).toRotationMatrix();
}

/// Weight off the principal axes, and two springs from body points to points of space.
inline systems::BodyLoads generic_loads() {
  systems::BodyLoads loads;
  loads.mass = 1.4;
  loads.center = {0.2, -0.1, 0.5};
  loads.gravity = {0.1, 0.2, -0.9};
  loads.springs = {{{0.7, 0.2, 0.1}, {1.5, 1.0, -0.5}, {0.8, 0.6}}, {{-0.3, 0.9, 0.4}, {-1.0, 1.2, 0.8}, {1.1, 0.0}}};
  return loads;
}
inline systems::BodyLoads generic_loads_about_the_center() {
  systems::BodyLoads loads = generic_loads();
  loads.center.setZero();
  return loads;
}

/// The symmetric heavy top with moments (I₁, I₁, I₃): mass 1, centre of mass at l e₃, gravity g down.
struct HeavyTop {
  double I1 = 1, I3 = 1.5, g = 1, l = 0.5;
  systems::BodyLoads loads() const {
    systems::BodyLoads loads;
    loads.center = {0, 0, l};
    loads.gravity = {0, 0, -g};
    return loads;
  }
  Eigen::Matrix3d A() const { return Eigen::Vector3d(I1, I1, I3).asDiagonal(); }
  systems::FixedPointBody body() const { return systems::FixedPointBody({systems::second_moment(A()), loads()}); }
  systems::EulerTop<systems::LoadTorque> by_euler() const {
    return systems::EulerTop<systems::LoadTorque>({A(), {loads()}});
  }
};

}  // namespace pseudorigid::testing
