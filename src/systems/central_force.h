#pragma once
/// Central forces: the potential energy V(r) depends on the distance r = |d| of two points, and the force on the one at
/// separation d from the other is
///
///   f = −(V′(r)/r) d,   −f on the other (action and reaction, Oliva 5.5.1, II).
///
/// Spring:      V = ½k(r − l)²,   V′/r = k(1 − l/r)
/// Attraction:  V = −k/r,         V′/r = k/r³

#include <Eigen/Core>
#include <cmath>

#include "mechanics/core/status.h"

namespace pseudorigid::systems {

struct SpringLaw {
  double stiffness = 0, rest_length = 0;
  double energy(double r) const { return 0.5 * stiffness * (r - rest_length) * (r - rest_length); }
  double slope_over_distance(double r) const {
    return rest_length == 0 ? stiffness : stiffness * (1 - rest_length / r);
  }
};

struct AttractionLaw {
  double strength = 0;
  double energy(double r) const { return -strength / r; }
  double slope_over_distance(double r) const { return strength / (r * r * r); }
};

/// f = −(V′(r)/r) d; fails if the force has no direction or no finite size.
template <class Law>
mechanics::Status central_force(const Law& law, const Eigen::Vector3d& d, Eigen::Vector3d& f) {
  const double slope_over_distance = law.slope_over_distance(d.norm());
  if (!std::isfinite(slope_over_distance))
    return mechanics::Status::failure("two points that act on each other coincide, or their distance is not finite");
  f = -slope_over_distance * d;
  return {};
}

}  // namespace pseudorigid::systems
