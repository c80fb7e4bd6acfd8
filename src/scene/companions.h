#pragma once
/// Checks of companions in orbit (loads/companions.h). There are at most two companions, with positive masses. The
/// orbits are given in one of two forms. Either each companion has a position, and all or none have velocities, or each
/// companion has orbital elements, of which only the semi-major axis is required. This axis is not 0. An eccentricity
/// is in [0, 1) if the semi-major axis is positive, and above 1 if this axis is negative. The constant of gravity must
/// be positive. The full potential (Companions/Full potential) needs a companion and a finite-element model. Each
/// companion must be farther from the centre of the initial body than all points of this body, at a finite position.
/// Two companions must not have the same place. A companion with a position but no velocity must not be on the z axis
/// through the centre of its orbit. Drag, planes, and constant or periodic tidal matrices are refused. These loads act
/// on the body but not on the companions, and would therefore change the orbit.

#include <optional>

#include "scene/catalogue.h"

namespace pseudorigid::scene {

/// Returns the violated requirement, or nothing. A scene that sets none of the entries of companions does not have
/// requirements.
std::optional<Refusal> refuses_companions(const Scene& scene);

}  // namespace pseudorigid::scene
