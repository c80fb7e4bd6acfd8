#pragma once
/// The systems of the program besides the ball. A new one is its header and one line here.

#include <tuple>

#include "systems/double_pendulum_scene.h"
#include "systems/geodesic_scene.h"
#include "systems/jacobi_geodesic_scene.h"
#include "systems/mass_points_scene.h"
#include "systems/moving_frame_scene.h"
#include "systems/rigid_body_scene.h"
#include "systems/torus_scene.h"

namespace pseudorigid::systems {

using SystemTable = std::tuple<MassPointsScene, DoublePendulumScene, RigidBodyScene, MovingFrameScene, TorusScene,
                               GeodesicScene, JacobiGeodesicScene>;

/// Calls visitor(SystemScene{}) for each of them.
template <class Visitor>
void for_each_system(Visitor&& visitor) {
  std::apply([&](const auto&... system) { (visitor(system), ...); }, SystemTable{});
}

}  // namespace pseudorigid::systems
