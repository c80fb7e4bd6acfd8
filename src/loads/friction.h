#pragma once
/// Friction at one point of the surface (plane.h). The point has the tangential velocity v_t, and w = √(|v_t|² + s²)
/// with the slip speed s. The coefficient of friction is f. The pressure p = k d, with the stiffness k and the
/// penetration d, does not include damping. The traction is F = −f p v_t/w = −∂R/∂v with the convex function R = f p w.
/// The two linearisations of F = F(v) (mechanics/core/damping.h) are
///
///   secant   −f p u_t/w,     tangent   −(f p/w) [u_t − v_t (v_t·u_t)/w²]
///
/// for a change u of the velocity with the tangential part u_t. Both are symmetric. For v_t = 0, both are −f p u_t/s.

#include <Eigen/Core>
#include <cmath>

#include "loads/plane.h"
#include "mechanics/core/linearization.h"

namespace pseudorigid::loads {

class Friction {
 public:
  /// Sets the plane and the velocity v of the point. The plane must outlive the object.
  Friction(const Plane& plane, const Eigen::Vector3d& v)
      : plane_(plane), tangential_(tangential(v)), w_(std::hypot(tangential_.norm(), plane.slip_speed)) {}

  /// Returns the traction F per reference area for the pressure p.
  Eigen::Vector3d traction(double p) const { return -plane_.friction * p / w_ * tangential_; }
  /// Returns the dissipated power −F·v per reference area for the pressure p.
  double power(double p) const { return plane_.friction * p / w_ * tangential_.squaredNorm(); }
  /// Returns the linearised change of F for a change u of the velocity, with the linearisation `kind`.
  Eigen::Vector3d change(double p, const Eigen::Vector3d& u, mechanics::Linearization kind) const {
    Eigen::Vector3d along = tangential(u);
    if (kind == mechanics::Linearization::tangent) along -= tangential_ * (tangential_.dot(along) / (w_ * w_));
    return -plane_.friction * p / w_ * along;
  }

 private:
  Eigen::Vector3d tangential(const Eigen::Vector3d& v) const { return v - plane_.normal.dot(v) * plane_.normal; }

  const Plane& plane_;
  Eigen::Vector3d tangential_;  ///< tangential velocity v_t
  double w_;                    ///< w = √(|v_t|² + s²)
};

}  // namespace pseudorigid::loads
