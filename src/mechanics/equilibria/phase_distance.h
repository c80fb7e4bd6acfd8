#pragma once
/// How far a state (q, q̇) is from a critical point (q₀, 0):
///
///   d = |(q − q₀, q̇)|,   with coordinates of a period P > 0 taken modulo P.

#include <Eigen/Core>
#include <cmath>

namespace pseudorigid::mechanics {

/// `periods`: P of each coordinate; 0 if it has none.
template <class Vector>
double phase_distance(const Vector& q, const Vector& v, const Eigen::VectorXd& q0, const Eigen::VectorXd& periods) {
  Eigen::VectorXd d = q - q0;
  for (Eigen::Index i = 0; i < d.size(); ++i)
    if (periods[i] > 0) d[i] = std::remainder(d[i], periods[i]);
  return std::hypot(d.norm(), v.norm());
}

}  // namespace pseudorigid::mechanics
