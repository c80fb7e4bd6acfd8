#pragma once
/// The systems other than the ball. A new system needs its header and one line in table.cpp.

#include <vector>

#include "systems/any_system_scene.h"

namespace pseudorigid::systems {

const std::vector<AnySystemScene>& system_table();

}  // namespace pseudorigid::systems
