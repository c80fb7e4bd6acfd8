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
  template <class T>
  T slope_over_distance(T r) const {
    return rest_length == 0 ? T(stiffness) : T(stiffness * (1.0 - rest_length / r));
  }
};

struct AttractionLaw {
  double strength = 0;
  double energy(double r) const { return -strength / r; }
  template <class T>
  T slope_over_distance(T r) const {
    return strength / (r * r * r);
  }
};

/// Adds −(V′(r)/r) d over any scalar. The value is 1 if the force has a direction and a finite size, otherwise a NaN.
/// A product of such values keeps the NaN; std::min may drop it.
template <class Law, class T>
T add_central_force(const Law& law, const Eigen::Matrix<T, 3, 1>& d, Eigen::Matrix<T, 3, 1>& f) {
  using std::sqrt;
  const T slope_over_distance = law.slope_over_distance(T(sqrt(d.squaredNorm())));
  f -= slope_over_distance * d;
  return T(1.0) + T(0.0) * slope_over_distance;
}

/// The status that belongs to this value.
inline mechanics::Status status_of_force(double reserve) {
  if (reserve > 0) return {};
  return mechanics::Status::failure("two points that act on each other coincide, or their distance is not finite");
}

/// f = −(V′(r)/r) d; fails if the force has no direction or no finite size.
template <class Law>
mechanics::Status central_force(const Law& law, const Eigen::Vector3d& d, Eigen::Vector3d& f) {
  f.setZero();
  return status_of_force(add_central_force(law, d, f));
}

}  // namespace pseudorigid::systems
