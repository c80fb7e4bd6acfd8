#pragma once
/// Conversions between Eigen matrices and the tensors of the material laws (tensor.h).

#include <Eigen/Core>

#include "materials/tensor.h"

namespace pseudorigid::materials {

[[gnu::always_inline]] inline Tensor<double> to_tensor(const Eigen::Matrix3d& m) {
  return {{{m(0, 0), m(0, 1), m(0, 2)}, {m(1, 0), m(1, 1), m(1, 2)}, {m(2, 0), m(2, 1), m(2, 2)}}};
}

[[gnu::always_inline]] inline void to_matrix(const Tensor<double>& t, Eigen::Matrix3d& m) {
  m(0, 0) = t(0, 0), m(1, 0) = t(1, 0), m(2, 0) = t(2, 0);
  m(0, 1) = t(0, 1), m(1, 1) = t(1, 1), m(2, 1) = t(2, 1);
  m(0, 2) = t(0, 2), m(1, 2) = t(1, 2), m(2, 2) = t(2, 2);
}

[[gnu::always_inline]] inline Eigen::Matrix3d to_matrix(const Tensor<double>& t) {
  Eigen::Matrix3d m;
  to_matrix(t, m);
  return m;
}

}  // namespace pseudorigid::materials
