#include "reduced/center_of_mass.h"

#include <unsupported/Eigen/MatrixFunctions>

namespace pseudorigid::reduced {

CenterOfMass::Motion CenterOfMass::at(double t) const {
  if (quadratic.isZero(0) && drag == 0)
    return {position + t * (velocity + t / 2 * acceleration), velocity + t * acceleration};
  Eigen::Matrix<double, 7, 7> A = Eigen::Matrix<double, 7, 7>::Zero();
  A.block<3, 3>(0, 3).setIdentity();
  A.block<3, 3>(3, 0) = -quadratic;
  A.block<3, 3>(3, 3) = -drag * Eigen::Matrix3d::Identity();
  A.block<3, 1>(3, 6) = acceleration;
  Eigen::Matrix<double, 7, 1> start;
  start << position, velocity, 1;
  const Eigen::Matrix<double, 7, 1> now = (t * A).exp() * start;
  return {now.head<3>(), now.segment<3>(3)};
}

}  // namespace pseudorigid::reduced
