#pragma once
/// Conversions between antisymmetric 3×3 matrices and vectors.

#include <Eigen/Core>

namespace pseudorigid::mechanics {

/// Returns the vector with the components Σ_jk ε_ijk A_jk, called the axial vector of A. The symmetric part of A does
/// not contribute. The axial vector of cross_matrix(w) is −2w.
inline Eigen::Vector3d axial_vector(const Eigen::Matrix3d& A) {
  return {A(1, 2) - A(2, 1), A(2, 0) - A(0, 2), A(0, 1) - A(1, 0)};
}

/// Returns the antisymmetric matrix of the linear map a ↦ w × a.
inline Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& w) {
  return (Eigen::Matrix3d() << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0).finished();
}

}  // namespace pseudorigid::mechanics
