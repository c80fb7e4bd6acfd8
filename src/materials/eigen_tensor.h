#pragma once
/// Conversions between Eigen matrices and tensors.

#include <Eigen/Core>

#include "materials/tensor.h"

namespace pseudorigid::materials {

inline Tensor<double> to_tensor(const Eigen::Matrix3d& m) {
  Tensor<double> t;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) t(i, j) = m(i, j);
  return t;
}

inline Eigen::Matrix3d to_matrix(const Tensor<double>& t) {
  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m(i, j) = t(i, j);
  return m;
}

}  // namespace pseudorigid::materials
