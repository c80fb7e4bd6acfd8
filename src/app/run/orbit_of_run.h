#pragma once
/// Companions (mechanics/core/orbit.h) in the run of a model.

#include <Eigen/Core>

#include "mechanics/core/orbit.h"
#include "mechanics/core/status.h"

namespace pseudorigid::app {

/// The columns of Q, and the coordinates s of the companions over their norms at the start. Time/Tolerance bounds the
/// error of these columns.
inline Eigen::MatrixXd with_companions(const Eigen::Matrix3d& Q, const mechanics::Orbit& orbit,
                                       const mechanics::Orbit::Columns& s) {
  Eigen::MatrixXd columns(3, 3 + orbit.n());
  columns << Q, s * orbit.position().colwise().norm().cwiseInverse().asDiagonal();
  return columns;
}

/// Fails if a companion has come to the body with the second moment S.
inline mechanics::Status meets_companion(const mechanics::Orbit& orbit, const Eigen::Matrix3d& S,
                                         const mechanics::Orbit::Columns& s) {
  if (!orbit.is_inside(S, s)) return {};
  return mechanics::Status::failure(
      "a companion has come as near to the centre of the body as its longest semi-axis: a collision");
}

}  // namespace pseudorigid::app
