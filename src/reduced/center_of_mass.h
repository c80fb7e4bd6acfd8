#pragma once
/// The centre of mass under loads (loads/forcing.h): a uniform acceleration b, a quadratic potential ½ xᵀTx per mass
/// and a drag with the coefficient c per mass. The equation of motion of its position x is linear and does not contain
/// the deformation of the body,
///
///   ẍ = b − T x − c ẋ.
///
/// If no load depends on time, the solution is exact: (x, ẋ, 1)(t) = exp(tA) (x₀, ẋ₀, 1) with the matrix A of this
/// linear equation. Otherwise the motion is integrated to round-off. The loads that depend on time have the potential
/// φ(x, t) per mass. The integration also computes the energy w per mass that these loads have given,
///
///   w(t) = ∫ ∂φ/∂t dt,   φ(x, t) = ½ xᵀT(t)x − b(t)·x,   so that  ½|ẋ|² + φ − w + ∫c|ẋ|² dt  is constant.

#include <Eigen/Core>
#include <memory>

#include "loads/list.h"
#include "mechanics/core/by_name.h"

namespace pseudorigid::reduced {

struct CenterOfMass {
  ByName by_name{};
  Eigen::Vector3d position = Eigen::Vector3d::Zero(), velocity = Eigen::Vector3d::Zero();  ///< x and ẋ at time 0
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();                                  ///< uniform acceleration b
  Eigen::Matrix3d quadratic = Eigen::Matrix3d::Zero();  ///< matrix T of the quadratic potential
  double drag = 0;                                      ///< drag coefficient c
  loads::Loads driving{};                               ///< loads that depend on time

  struct Motion {
    Eigen::Vector3d x, v;
    double work = 0;  ///< energy w per mass that the loads depending on time have given
  };

  /// Returns the exact motion at the time t for the loads that do not depend on time. With an unstable T, the motion
  /// can exceed the largest number at a late time. The result is then not finite.
  Motion at(double t) const;

  /// The kinetic energy per mass, and the energy per mass in the potential of the loads that do not depend on time.
  static double kinetic(const Motion& m) { return 0.5 * m.v.squaredNorm(); }
  double potential(const Motion& m) const { return 0.5 * m.x.dot(quadratic * m.x) - acceleration.dot(m.x); }
  /// Energy per mass of the loads that depend on time, minus the energy that these loads have given.
  double driven(const Motion& m, double t) const;
};

/// The motion of the centre of mass. The result for a time does not depend on earlier requests. If the requested time
/// is before the last step, the integration starts again at the time 0.
class CenterPath {
 public:
  explicit CenterPath(const CenterOfMass& center);
  CenterPath(const CenterPath&) = delete;  // the integration has a pointer to the member center_
  CenterPath& operator=(const CenterPath&) = delete;
  ~CenterPath();

  const CenterOfMass& law() const { return center_; }
  /// The motion at the time t ≥ 0. The result is NaN if the integration fails, and not finite if the motion exceeds the
  /// largest number.
  CenterOfMass::Motion at(double t);

 private:
  struct Integration;
  CenterOfMass center_;
  std::unique_ptr<Integration> integration_;  ///< null if the solution is exact
};

}  // namespace pseudorigid::reduced
