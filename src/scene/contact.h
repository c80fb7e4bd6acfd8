#pragma once
/// Checks of rigid planes (loads/rigid_planes.h). Each normal must be nonzero and must have a point. The surface of the
/// body must be known. The initial body with centre x_c and deformation Q₀ must be in front of each plane n·x = z₀:
///
///   n·x ≥ z₀ for all x of the body,   that is   n·x_c − |S Q₀ᵀn| r ≥ z₀,   S = diag(semi-axes).

#include <optional>

#include "scene/catalogue.h"

namespace pseudorigid::scene {

/// Returns the violated requirement, or nothing. A scene without planes does not have requirements.
std::optional<Refusal> refuses_planes(const Scene& scene);

}  // namespace pseudorigid::scene
