#pragma once
/// Companions (mechanics/core/orbit.h) in the run of a model.

#include <Eigen/Core>
#include <optional>
#include <utility>

#include "mechanics/core/orbit.h"
#include "mechanics/core/status.h"

namespace pseudorigid::app {

/// The columns of Q, and the positions r_i of the companions over their distances at the start. Time/Tolerance bounds
/// the error of these columns.
inline Eigen::MatrixXd with_companions(const Eigen::Matrix3d& Q, const mechanics::Orbit& orbit,
                                       const mechanics::Orbit::Columns& s) {
  Eigen::MatrixXd columns(3, 3 + orbit.n());
  const mechanics::Orbit::Columns at_start = orbit.relative(orbit.position());
  columns << Q, orbit.relative(s) * at_start.colwise().norm().cwiseInverse().asDiagonal();
  return columns;
}

/// Looks for a collision in every step. The companions move on straight lines within a step.
class CollisionWatch {
 public:
  /// Fails if a companion has come to the body with the second moment S, or to the other companion. After a jump back
  /// in time, the step before t is not known.
  mechanics::Status look(double t, const mechanics::Orbit& orbit, const Eigen::Matrix3d& S,
                         const mechanics::Orbit::Columns& s) {
    const bool follows = before_ && before_->first < t;
    const double distance = orbit.least_distance(follows ? before_->second : s, s);
    before_.emplace(t, s);
    if (distance > orbit.largest_semi_axis(S)) return {};
    return mechanics::Status::failure(
        "a collision: a companion has come nearer than the longest semi-axis of the body to its centre, or to the "
        "other "
        "companion");
  }

 private:
  std::optional<std::pair<double, mechanics::Orbit::Columns>> before_;  ///< time and coordinates after the last step
};

}  // namespace pseudorigid::app
