#pragma once
/// The centre of mass under the loads that the pseudo-rigid body knows: uniform acceleration b, the quadratic potential
/// ½ xᵀTx per mass and linear drag c. Its law is linear and separate from that of Q,
///
///   ẍ = b − T x − c ẋ,
///
/// so x(t) is known exactly: (x, ẋ, 1)(t) = exp(tA) (x₀, ẋ₀, 1).

#include <Eigen/Core>

#include "mechanics/by_name.h"

namespace pseudorigid::reduced {

struct CenterOfMass {
  ByName by_name{};
  Eigen::Vector3d position = Eigen::Vector3d::Zero(), velocity = Eigen::Vector3d::Zero();  ///< at time 0
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();                                  ///< b
  Eigen::Matrix3d quadratic = Eigen::Matrix3d::Zero();                                     ///< T
  double drag = 0;                                                                         ///< c

  struct Motion {
    Eigen::Vector3d x, v;
  };

  /// Not finite where an unstable T has carried it beyond all numbers.
  Motion at(double t) const;

  /// Energies per mass.
  static double kinetic(const Motion& m) { return 0.5 * m.v.squaredNorm(); }
  double potential(const Motion& m) const { return 0.5 * m.x.dot(quadratic * m.x) - acceleration.dot(m.x); }
};

}  // namespace pseudorigid::reduced
