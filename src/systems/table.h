#pragma once
/// The systems other than the ball. A new system needs its header and one line in table.cpp.

#include <vector>

#include "systems/any_system_scene.h"

namespace pseudorigid::systems {

/// The scenes of all systems other than the ball, in the order of the documentation.
const std::vector<AnySystemScene>& system_table();

}  // namespace pseudorigid::systems
