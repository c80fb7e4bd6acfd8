#pragma once
/// Companions, which are point masses in orbit with the body (mechanics/core/orbit.h), in the run of a model. This file
/// has their columns of the configuration, and detects collisions and disruptions.

#include <Eigen/Core>
#include <optional>
#include <utility>

#include "mechanics/core/orbit.h"
#include "mechanics/core/status.h"

namespace pseudorigid::app {

/// A matrix with the three columns of the deformation Q and a column r_i/|r_i(0)| for each companion i. Here r_i is the
/// position of the companion relative to the body. Time/Tolerance bounds the error of these columns.
Eigen::MatrixXd with_companions(const Eigen::Matrix3d& Q, const mechanics::Orbit& orbit,
                                const mechanics::Orbit::Columns& s);

/// The kinetic and gravitational energy of the body about its centre, in internal units. The body is regarded as the
/// ellipsoid with the present second moment S = ∫ρ x xᵀ dV, in the affine motion Q with the rate Q̇. The result is
/// exact for a pseudo-rigid fluid.
double own_energy(const mechanics::Orbit& orbit, const Eigen::Matrix3d& S, const Eigen::Matrix3d& Q,
                  const Eigen::Matrix3d& Qdot);

/// Detects collisions and disruptions in a run. The companions are assumed to move on straight lines within a step.
class CollisionWatch {
 public:
  /// Checks the state at the end of a step for a collision or a disruption. S is the second moment of the body, ∫ρ x xᵀ
  /// dV about its centre, and s has the coordinates of the companions. In the first call and after a jump back in time,
  /// the step before t is not known, and only the positions at t count.
  ///
  /// Fails after a collision. A companion has then been nearer to the centre of the body, or to the other companion,
  /// than the longest semi-axis of the body.
  ///
  /// Also fails after a disruption by the tide. The longest semi-axis then exceeds the least Hill radius, and the body
  /// is not bound by its gravity: `energy_of_body()` is positive. This function must return the sum of the kinetic and
  /// gravitational energies of the body about its centre, or a negative number for a solid. An equilibrium under tide
  /// and spin has a negative sum. A body that is stretched beyond the Hill radius for a short time is therefore not
  /// regarded as disrupted.
  template <class OwnEnergy>
  mechanics::Status look(double t, const mechanics::Orbit& orbit, const Eigen::Matrix3d& S,
                         const mechanics::Orbit::Columns& s, const OwnEnergy& energy_of_body) {
    const bool follows = before_ && before_->first < t;
    const double distance = orbit.least_distance(follows ? before_->second : s, s);
    before_.emplace(t, s);
    const double longest = orbit.largest_semi_axis(S);
    if (longest > orbit.hill_radius(s) && energy_of_body() > 0)
      return mechanics::Status::failure(
          "a disruption: the tide has pulled the body beyond its Hill radius, and its gravity does not bind it any "
          "more");
    if (distance > longest) return {};
    return mechanics::Status::failure(
        "a collision: a companion has come nearer than the longest semi-axis of the body to its centre, or to the "
        "other companion");
  }

 private:
  std::optional<std::pair<double, mechanics::Orbit::Columns>> before_;  ///< time and coordinates after the last step
};

}  // namespace pseudorigid::app
