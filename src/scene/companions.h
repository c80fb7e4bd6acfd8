#pragma once
/// Checks of companions in orbit (loads/companions.h). There are at most two. Either each has a position, and all or
/// none have velocities, or each has orbital elements. The constant of gravity must be positive. Loads that act on the
/// centre of mass of the body alone are refused, because they would change the orbit: drag, planes, and tides that are
/// fixed in space.

#include <optional>

#include "scene/catalogue.h"

namespace pseudorigid::scene {

/// Returns the violated requirement, or nothing. A scene without companions does not have requirements.
std::optional<Refusal> refuses_companions(const Scene& scene);

}  // namespace pseudorigid::scene
