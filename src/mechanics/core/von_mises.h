#pragma once
/// The von Mises stress of a Cauchy stress σ:
///
///   σ_v = √(3/2) |dev σ|,   dev σ = σ − (tr σ/3) Id
///
/// A pressure does not change it.

#include <Eigen/Core>
#include <cmath>

namespace pseudorigid::mechanics {

inline double von_mises(const Eigen::Matrix3d& stress) {
  return std::sqrt(1.5) * (stress - stress.trace() / 3 * Eigen::Matrix3d::Identity()).norm();
}

}  // namespace pseudorigid::mechanics
