#include "reduced/principal_plane.h"

#include <Eigen/SVD>
#include <cmath>

#include "mechanics/core/dense_algebra.h"

namespace pseudorigid::reduced {

SteadyMotion to_principal_plane(const SteadyMotion& m) {
  SteadyMotion p = m;
  if (!m.A.isDiagonal(0) || !(m.A.diagonal().minCoeff() > 0)) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m.A, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const double side = svd.matrixU().determinant() > 0 ? 1 : -1;  // det U = det V, because det A > 0
    p = {svd.singularValues().asDiagonal(), side * svd.matrixU().transpose() * m.omega,
         side * svd.matrixV().transpose() * m.Lambda, m.lambda};
  }
  Eigen::Index normal = 0;
  (p.omega.cwiseAbs2() + p.Lambda.cwiseAbs2()).minCoeff(&normal);
  Eigen::Matrix3d P;  // the cyclic permutation that moves axis `normal` to axis 1
  for (int i = 0; i < 3; ++i) P.row(i) = Eigen::Vector3d::Unit((i + normal) % 3).transpose();
  return {P * p.A * P.transpose(), P * p.omega, P * p.Lambda, p.lambda};
}

namespace detail {

PlaneVector newton_step(const PlaneMatrix& DF, const PlaneVector& F, double round_off) {
  const auto [U, values, V] = mechanics::singular_value_decomposition(DF);
  PlaneVector components = U.transpose() * F;
  for (int i = 0; i < 8; ++i) components[i] = std::abs(components[i]) <= round_off ? 0 : components[i] / values[i];
  return V * components;
}

}  // namespace detail

}  // namespace pseudorigid::reduced
