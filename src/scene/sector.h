#pragma once
/// The sector of the ball that has to be computed. A motion x = x_c + Q(t) X + … can have the coordinate plane with
/// normal e_i as a symmetry plane. The condition is that the reflection S_i = Id - 2 e_i e_i^T does not change the
/// initial state and the loads. The matrices A among them (Q0, Qdot0, E0 and matrices of loads) must satisfy S_i A S_i
/// = A, so their entries (i,j) and (j,i), j != i, are zero. The vectors a (centre of mass, its velocity and vectors of
/// loads) must satisfy S_i a = a, so a_i = 0.

#include <array>
#include <optional>
#include <string>

#include "scene/scene.h"

namespace pseudorigid::scene {

struct Sector {
  std::array<bool, 3> reflect{};  ///< whether the planes with normals x, y, z bound the sector
  std::string reason;             ///< reason for this sector in one sentence

  int n_planes() const { return reflect[0] + reflect[1] + reflect[2]; }
  /// The number of copies of the sector that fill the ball.
  int n_images() const { return 1 << n_planes(); }
  /// "octant", "quarter (planes x, y)", "half (plane z)" or "full ball".
  std::string name() const;
};

inline constexpr std::array<const char*, 3> axis_names{"x", "y", "z"};

/// The planes that a value of Continuum/Symmetry names. Symmetry::automatic does not name planes.
std::array<bool, 3> planes_of(Symmetry symmetry);

/// Describes the first entry of the initial state or of the loads that breaks the symmetry about the plane with normal
/// e_i ("entry (1,2) of Initial state/Velocity is 0.5 and not 0"). Empty if the motion has this symmetry.
std::optional<std::string> breaks_plane(const Scene& scene, int i);

/// Whether Q preserves all three symmetry planes and is therefore diagonal for all times. The centre of mass does not
/// matter, because it does not affect Q.
bool keeps_diagonal(const Scene& scene);

/// The sector of the scene: the given sector, or the smallest sector that the initial state and the loads admit.
Sector sector(const Scene& scene);

}  // namespace pseudorigid::scene
