#include "systems/table.h"

#include "systems/double_pendulum_scene.h"
#include "systems/fixed_axis_scene.h"
#include "systems/geodesic_scene.h"
#include "systems/jacobi_geodesic_scene.h"
#include "systems/mass_points_scene.h"
#include "systems/moving_frame_scene.h"
#include "systems/rigid_body_scene.h"
#include "systems/spherical_pendulum_scene.h"
#include "systems/torus_scene.h"

namespace pseudorigid::systems {
namespace {

template <class... SystemScenes>
std::vector<AnySystemScene> make_table() {
  return {any_system_scene<SystemScenes>()...};
}

}  // namespace

const std::vector<AnySystemScene>& system_table() {
  static const auto table = make_table<MassPointsScene,         //
                                       DoublePendulumScene,     //
                                       RigidBodyScene,          //
                                       MovingFrameScene,        //
                                       TorusScene,              //
                                       GeodesicScene,           //
                                       JacobiGeodesicScene,     //
                                       SphericalPendulumScene,  //
                                       FixedAxisScene>();
  return table;
}

}  // namespace pseudorigid::systems
