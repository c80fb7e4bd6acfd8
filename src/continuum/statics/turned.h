#pragma once
/// Infinitesimal rotations of nodal fields.

#include "continuum/mesh/ball_space.h"

namespace pseudorigid::continuum {

/// ê×u at every node, for the unit vector ê of an axis (0, 1 or 2).
inline Vector turned(const BallSpace& space, int axis, const Vector& u) {
  Vector result = space.make_vector();
  const auto p = static_cast<unsigned int>((axis + 1) % 3), q = static_cast<unsigned int>((axis + 2) % 3);
  for (unsigned int i = 0; i < 3 * space.n_nodes(); i += 3) {
    result.local_element(i + p) = -u.local_element(i + q);
    result.local_element(i + q) = u.local_element(i + p);
  }
  return result;
}

}  // namespace pseudorigid::continuum
