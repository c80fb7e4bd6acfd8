#pragma once
/// The sector of the ball that has to be computed. A motion x = x_c + Q(t) X + … with the centre of mass x_c can have a
/// coordinate plane as a symmetry plane. The reflection at the plane with normal e_i is S_i = Id − 2 e_i e_iᵀ. The
/// plane is a symmetry plane if the initial state and the loads are invariant under S_i. A matrix A (the initial Q₀ and
/// Q̇₀, the inertia E₀ or a matrix of a load) must satisfy S_i A S_i = A. Its entries (i,j) and (j,i) with j ≠ i must
/// therefore be zero. A vector a (centre of mass, its velocity or a vector of a load) must satisfy S_i a = a, that is
/// a_i = 0. A load can have a function `breaks_plane`, which replaces these conditions on the entries of the load.

#include <array>
#include <optional>
#include <string>

#include "scene/scene.h"

namespace pseudorigid::scene {

struct Sector {
  std::array<bool, 3> reflect{};  ///< true for each normal x, y, z whose plane bounds the sector
  std::string reason;             ///< reason for this sector in one sentence

  int n_planes() const { return reflect[0] + reflect[1] + reflect[2]; }
  /// The number of copies of the sector that fill the ball.
  int n_images() const { return 1 << n_planes(); }
  /// Returns "octant", "quarter (planes x, y)", "half (plane z)" or "full ball".
  std::string name() const;
};

inline constexpr std::array<const char*, 3> axis_names{"x", "y", "z"};

/// The planes that a value of Continuum/Symmetry names: true for each of the normals x, y, z. For Symmetry::automatic,
/// all are false.
std::array<bool, 3> planes_of(Symmetry symmetry);

/// Describes the first entry of the initial state, Body/Inertia or the loads that breaks the symmetry about the plane
/// with the normal e_i, with i = 0, 1, 2 for x, y, z. An example is "entry (1,2) of Initial state/Velocity is 0.5 and
/// not 0". The result is empty if the plane is a symmetry plane of the motion.
std::optional<std::string> breaks_plane(const Scene& scene, int i);

/// Returns true if all matrices of the initial state, the inertia and the loads are invariant under the three
/// reflections S_i. If there are no rigid planes and no companions, Q is then diagonal at all times. Rigid planes and
/// companions are not checked. Vectors are not checked because they affect the centre of mass but not Q. Viscoelastic
/// branches are not checked because they admit every reflection.
bool keeps_diagonal(const Scene& scene);

/// The sector of the scene. With Continuum/Symmetry = auto, it is the smallest sector that the initial state and the
/// loads admit. Otherwise it is the sector that Continuum/Symmetry sets, which is not checked here. With a mesh from a
/// file it is the whole body.
Sector sector(const Scene& scene);

}  // namespace pseudorigid::scene
