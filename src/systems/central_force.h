#pragma once
/// Central forces. The potential energy V(r) depends on the distance r = |d| of two points. If d is the vector from the
/// second point to the first, the force on the first point is
///
///   f = −(V′(r)/r) d,   and −f acts on the second point (action and reaction, Oliva 5.5.1, II).
///
/// Spring:      V = ½k(r − l)²,   V′/r = k(1 − l/r)   with stiffness k and rest length l
/// Attraction:  V = −k/r,         V′/r = k/r³

#include <Eigen/Core>
#include <cmath>

#include "mechanics/core/status.h"

namespace pseudorigid::systems {

/// Stiffness k and rest length l of a spring. The function slope_over_distance returns V′(r)/r.
struct SpringLaw {
  double stiffness = 0, rest_length = 0;
  double energy(double r) const { return 0.5 * stiffness * (r - rest_length) * (r - rest_length); }
  template <class T>
  T slope_over_distance(T r) const {
    return rest_length == 0 ? T(stiffness) : T(stiffness * (1.0 - rest_length / r));
  }
};

/// The attraction with the strength k. The function slope_over_distance returns V′(r)/r.
struct AttractionLaw {
  double strength = 0;
  double energy(double r) const { return -strength / r; }
  template <class T>
  T slope_over_distance(T r) const {
    return strength / (r * r * r);
  }
};

/// Adds −(V′(r)/r) d to f, for any scalar type. Returns 1 if V′(r)/r is finite, otherwise NaN. At r = 0, V′(r)/r is
/// finite only for a spring with rest length 0. To combine several calls, multiply their results, because a product
/// preserves a NaN and std::min may lose it.
template <class Law, class T>
T add_central_force(const Law& law, const Eigen::Matrix<T, 3, 1>& d, Eigen::Matrix<T, 3, 1>& f) {
  using std::sqrt;
  const T slope_over_distance = law.slope_over_distance(T(sqrt(d.squaredNorm())));
  f -= slope_over_distance * d;
  return T(1.0) + T(0.0) * slope_over_distance;
}

/// Returns success for the result 1 of add_central_force or for a product of such results. Returns a failure for NaN.
inline mechanics::Status status_of_force(double reserve) {
  if (reserve > 0) return {};
  return mechanics::Status::failure("two points that act on each other coincide, or their distance is not finite");
}

/// Computes f = −(V′(r)/r) d. Fails if V′(r)/r is not finite.
template <class Law>
mechanics::Status central_force(const Law& law, const Eigen::Vector3d& d, Eigen::Vector3d& f) {
  f.setZero();
  return status_of_force(add_central_force(law, d, f));
}

}  // namespace pseudorigid::systems
