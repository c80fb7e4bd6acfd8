#pragma once
/// Rigid planes that touch the unit ball about the origin.

#include "loads/plane.h"

namespace pseudorigid::testing {

/// Oblique planes that the unit ball about the origin is 0.2 and 0.1 behind.
inline loads::Planes oblique_planes(double damping = 0, double friction = 0) {
  using Eigen::Vector3d;
  const Vector3d n = Vector3d(0.3, -0.4, 0.8).normalized(), m = Vector3d(-1, 0.2, 0).normalized();
  return {
      {.normal = n, .position = -0.8, .stiffness = 30, .damping = damping, .friction = friction, .slip_speed = 0.3},
      {.normal = m, .position = -0.9, .stiffness = 50, .damping = damping, .friction = friction, .slip_speed = 0.3}};
}
/// The same planes in motion.
inline loads::Planes moving_planes(double damping, double friction) {
  loads::Planes planes = oblique_planes(damping, friction);
  planes[0].speed = 0.1;
  planes[1].speed = -0.05;
  planes[1].amplitude = 0.1;
  planes[1].frequency = 2;
  return planes;
}
/// Two that press the ball along z, and a mirror image of each.
inline loads::Planes press() {
  return {{.normal = Eigen::Vector3d::UnitZ(), .position = -0.9, .stiffness = 30},
          {.normal = -Eigen::Vector3d::UnitZ(), .position = -0.9, .stiffness = 30}};
}
/// The same, with friction and damping, and in motion towards each other.
inline loads::Planes rough_press() {
  loads::Planes planes = press();
  for (loads::Plane& plane : planes) {
    plane.damping = 0.4;
    plane.friction = 0.5;
    plane.slip_speed = 0.1;
    plane.speed = 0.2;
  }
  return planes;
}

}  // namespace pseudorigid::testing
