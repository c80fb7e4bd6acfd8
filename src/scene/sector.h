#pragma once
/// Which sector of the ball has to be computed. A motion x = x_c + Q(t) X + … keeps the coordinate plane with normal
/// e_i as a symmetry plane if the reflection S_i = Id - 2 e_i e_i^T leaves the initial state and the loads as they are:
/// S_i A S_i = A for the matrices Q0, Qdot0, E0 and those of the loads, that is, their entries (i,j) and (j,i), j != i,
/// are zero; and S_i a = a for the centre of mass, its velocity and the vectors of the loads, a_i = 0.

#include <array>
#include <optional>
#include <string>

#include "scene/scene.h"

namespace pseudorigid::scene {

struct Sector {
  std::array<bool, 3> reflect{};  ///< the planes with normals x, y, z that bound the sector
  std::string reason;             ///< why this sector, one sentence

  int n_planes() const { return reflect[0] + reflect[1] + reflect[2]; }
  /// How many copies of the sector fill the ball.
  int n_images() const { return 1 << n_planes(); }
  /// "octant", "quarter (planes x, y)", "half (plane z)" or "full ball".
  std::string name() const;
};

inline constexpr std::array<const char*, 3> axis_names{"x", "y", "z"};

/// The planes named by a choice of symmetry; none for Symmetry::automatic, which names no planes.
std::array<bool, 3> planes_of(Symmetry symmetry);

/// The first entry of the initial state or of the loads that breaks the symmetry about the plane with normal e_i, in
/// words ("entry (1,2) of Initial state/Velocity is 0.5"); empty if the plane is admissible.
std::optional<std::string> breaks_plane(const Scene& scene, int i);

/// Whether Q keeps all three planes, which makes it diagonal for all times. The centre of mass moves apart from Q and
/// may leave the planes.
bool keeps_diagonal(const Scene& scene);

/// The sector of the scene: the given one, or the smallest that initial state and loads admit.
Sector sector(const Scene& scene);

}  // namespace pseudorigid::scene
