#pragma once
/// A deformation far from affine, for solves with the Gram operator. It does not keep the volume: G is there at any x.

#include "continuum/body/ball_body.h"

namespace pseudorigid::testing {

/// x₃ = X₃ + s X₃ (X₁² − X₂²), x₁ = X₁ + s X₁ X₂²; a coordinate plane stays one.
inline continuum::Vector sheared(const continuum::BallBody& ball, double s) {
  continuum::Vector x = ball.affine_field(Eigen::Matrix3d::Identity());
  for (unsigned int i = 0; i < x.locally_owned_size(); i += 3) {
    double* p = &x.local_element(i);
    p[2] += s * p[2] * (p[0] * p[0] - p[1] * p[1]);
    p[0] += s * p[0] * p[1] * p[1];
  }
  return x;
}

}  // namespace pseudorigid::testing
