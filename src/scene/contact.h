#pragma once
/// Checks of rigid planes (loads/rigid_planes.h). Each normal must be nonzero, and each plane must have a point. The
/// lists of speeds and amplitudes are empty or have a number for each plane. The initial body must be in front of each
/// plane n·x = z₀ with the unit normal n and the position z₀ at time 0. For a body with radius r, centre x_c and
/// deformation Q₀, this condition is
///
///   n·x ≥ z₀ for all x of the body,   that is   n·x_c − |S Q₀ᵀn| r ≥ z₀,   S = diag(semi-axes).
///
/// A penetration that is only round-off is permitted. Only the entry Body/Semi-axes, which is in radii, describes the
/// surface of the body. A matrix Body/Inertia and a mesh from a file are therefore refused.

#include <optional>
#include <string>

#include "scene/catalogue.h"

namespace pseudorigid::scene {

/// Returns the violated requirement, or nothing. A scene that sets neither normals, points, speeds nor amplitudes of
/// planes does not have requirements.
std::optional<Refusal> refuses_planes(const Scene& scene);

/// The stiffness of the planes compared with the largest stiffness that the built-in mesh resolves. For elements of
/// degree N this largest stiffness is N(N + 1)μ/(2h). Here h is the length of the cells at a pole, along the axis, and
/// μ is the shear modulus. With a stiffer plane, the nodes of the surface oscillate on the plane
/// (tests/continuum/bouncing_bar_test.cpp).
struct MeshedContact {
  double cell;   ///< length h of the cells, in radii
  double ratio;  ///< stiffness of the planes divided by the largest resolved stiffness
  /// The largest ratio without a warning. In measured impacts, the rms oscillation of the force was 0.2 to 0.3 % of the
  /// largest force at the ratio 4. At the ratio 16, it was 0.5 to 1.5 % (docs/contact.md).
  static constexpr double most = 10;

  std::string line() const;     ///< a line with `ratio` and h for the list of needed parts
  std::string warning() const;  ///< a sentence for the user; empty if the ratio is at most `most`
};
/// The contact of the finite-element model of the scene. The result is empty if the scene has no planes or no
/// finite-element model, or if the body is a fluid. The result is also empty if a search chooses the degree or the
/// refinements.
std::optional<MeshedContact> meshed_contact(const Scene& scene);

}  // namespace pseudorigid::scene
