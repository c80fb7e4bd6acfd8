#pragma once
/// The systems other than the ball. A new system needs its header and one line in table.cpp.

#include <vector>

#include "systems/any_system_scene.h"

namespace pseudorigid::systems {

/// The scenes of the systems, in the order in which the documentation lists them.
const std::vector<AnySystemScene>& system_table();

}  // namespace pseudorigid::systems
