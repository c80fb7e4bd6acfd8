#pragma once
/// Which sector of the ball has to be computed. A motion x = Q(t) X + … keeps the coordinate plane with normal e_i as a
/// symmetry plane if the reflection S_i = Id - 2 e_i e_i^T commutes with the initial state: S_i Q0 S_i = Q0 and
/// S_i Qdot0 S_i = Qdot0, that is, if their entries (i,j) and (j,i), j != i, are zero.

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

/// An entry of the initial state that breaks a symmetry plane.
struct BrokenPlane {
  int row, column;   ///< from 0
  bool in_velocity;  ///< else in the deformation
};

/// The first entry that keeps the plane with normal e_i from being a symmetry plane; nothing if the plane is
/// admissible.
std::optional<BrokenPlane> breaks_plane(const Scene::InitialState& state, int i);

/// The sector that the scene asks for, the smallest one that the initial state admits if it leaves the choice.
Sector sector(const Scene& scene);

}  // namespace pseudorigid::scene
