#include "reduced/reference_body.h"

#include <Eigen/Eigenvalues>

namespace pseudorigid::reduced {

ReferenceBody ReferenceBody::of_inertia(const Eigen::Matrix3d& E0, double volume) {
  const Eigen::Matrix3d SST = 5 / volume * E0;
  return {E0, volume, volume, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(SST).operatorSqrt()};
}

}  // namespace pseudorigid::reduced
