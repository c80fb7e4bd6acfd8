#pragma once
/// Checks of rigid planes (loads/rigid_planes.h). Each normal must be nonzero, and each plane must have a point. Speeds
/// and amplitudes are empty or have a number for each plane. The surface of the body must be known. The initial body
/// must be in front of each plane n·x = z₀, where n is the unit normal and z₀ the position at time 0. For a body with
/// radius r, centre x_c and deformation Q₀, this condition is
///
///   n·x ≥ z₀ for all x of the body,   that is   n·x_c − |S Q₀ᵀn| r ≥ z₀,   S = diag(semi-axes).
///
/// A penetration that is only round-off is permitted. The entry Semi-axes, which is in radii, describes the surface. A
/// matrix Body/Inertia and a mesh from a file are therefore refused.

#include <optional>

#include "scene/catalogue.h"

namespace pseudorigid::scene {

/// Returns the violated requirement, or nothing. A scene without planes does not have requirements.
std::optional<Refusal> refuses_planes(const Scene& scene);

}  // namespace pseudorigid::scene
