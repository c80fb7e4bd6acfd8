#pragma once
/// Requirements of rigid planes (loads/rigid_planes.h): as many normals as points, normals with a direction, a body
/// whose surface is known, and a start at which
///
///   n·x ≥ z₀ for all x of the body,   that is   n·x_c − |S Q₀ᵀn| r ≥ z₀,   S = diag(semi-axes).

#include <optional>

#include "scene/catalogue.h"

namespace pseudorigid::scene {

/// Nothing without planes.
std::optional<Refusal> refuses_planes(const Scene& scene);

}  // namespace pseudorigid::scene
