#pragma once
/// Symmetries of systems under external forces (Noether's theorem). A rotation about the axis a does not change a
/// vector u if a × u = 0. A translation along e does not change the linear potential −⟨u, x⟩ of the position x if ⟨u,
/// e⟩ = 0.

#include <Eigen/Geometry>
#include <limits>
#include <vector>

namespace pseudorigid::systems {

using Directions = std::vector<Eigen::Vector3d>;

inline Directions all_directions() {
  return {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
}

/// Returns unit vectors along the axes whose rotations do not change the vectors. The list has three axes if every
/// vector is zero, and one axis if all nonzero vectors are parallel. Otherwise it is empty.
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

/// Returns an orthonormal basis of the directions perpendicular to u, with three vectors if u = 0, otherwise two.
inline Directions translations_across(const Eigen::Vector3d& u) {
  if (u.isZero(0)) return all_directions();
  const Eigen::Vector3d e = u.unitOrthogonal();
  return {e, u.stableNormalized().cross(e)};
}

}  // namespace pseudorigid::systems
