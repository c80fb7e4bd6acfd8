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
#include <string>

#include "scene/catalogue.h"

namespace pseudorigid::scene {

/// Returns the violated requirement, or nothing. A scene without planes does not have requirements.
std::optional<Refusal> refuses_planes(const Scene& scene);

/// The stiffness of the planes over the largest one that the builtin mesh resolves. For elements of degree N and the
/// length h of the cells at a pole, along the axis, this is N(N + 1)μ/(2h). With a stiffer plane, the nodes of the
/// surface swing on the plane (tests/continuum/bouncing_bar_test.cpp).
struct MeshedContact {
  double cell;   ///< h in radii
  double ratio;  ///< ratio of the stiffnesses.
  /// At the ratio 4, the force of an impact oscillates by 0.2 to 0.3 % of its largest value, and at 16 by 0.5 to 1.5 %
  /// (docs/contact.md).
  static constexpr double most = 10;

  std::string line() const;     ///< for the list of needed parts
  std::string warning() const;  ///< empty if the ratio is at most `most`
};
/// Nothing without planes, finite elements of a given degree and refinement, or shear modulus.
std::optional<MeshedContact> meshed_contact(const Scene& scene);

}  // namespace pseudorigid::scene
