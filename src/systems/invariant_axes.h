#pragma once
/// Symmetries that forces leave (Noether): the axes a whose rotations leave given vectors u unchanged, a × u = 0, and
/// the translations e that leave a linear potential −⟨u, x⟩ unchanged, ⟨u, e⟩ = 0.

#include <Eigen/Geometry>
#include <limits>
#include <vector>

namespace pseudorigid::systems {

using Directions = std::vector<Eigen::Vector3d>;

inline Directions all_directions() {
  return {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
}

/// All three axes if every vector is zero, one if they are parallel, none otherwise.
inline Directions turns_that_fix(const Directions& vectors) {
  constexpr double round_off = 16 * std::numeric_limits<double>::epsilon();
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  for (const auto& u : vectors)
    if (axis.isZero(0)) axis = u.stableNormalized();
  if (axis.isZero(0)) return all_directions();
  for (const auto& u : vectors)
    if (axis.cross(u).norm() > round_off * u.norm()) return {};
  return {axis};
}

/// Three directions if u = 0, else two that are orthogonal to it.
inline Directions translations_across(const Eigen::Vector3d& u) {
  if (u.isZero(0)) return all_directions();
  const Eigen::Vector3d e = u.unitOrthogonal();
  return {e, u.stableNormalized().cross(e)};
}

}  // namespace pseudorigid::systems
