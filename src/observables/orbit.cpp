#include "observables/orbit.h"

#include <Eigen/Core>
#include <cmath>

#include "mechanics/core/dense_algebra.h"
#include "mechanics/core/orbit.h"
#include "observables/body_observables.h"

namespace pseudorigid::mechanics {

OrbitObservables observe_orbit(const Orbit& orbit, const Orbit::Columns& s, const Orbit::Columns& sdot,
                               const Eigen::Matrix3d& S, const Eigen::Vector3d& J) {
  OrbitObservables o;
  const Orbit::Columns positions = orbit.relative(s), velocities = orbit.relative(sdot);
  const Eigen::Vector3d r = positions.col(0), v = velocities.col(0);
  o.kinetic = 0.5 * sdot.squaredNorm();
  o.interaction = orbit.energy(S, s);
  o.position = r;
  o.velocity = v;
  if (orbit.n() > 1) {
    o.second_position = positions.col(1);
    o.second_velocity = velocities.col(1);
  }
  o.elements = elements_of(r, v, orbit.gravity_of_pair());
  const double d = r.norm();
  const Eigen::Vector3d along = r / d, across = r.cross(v);
  const Eigen::Vector3d normal = across.isZero(0) ? Eigen::Vector3d::Zero().eval() : across.normalized().eval(),
                        ahead = normal.cross(along);
  const double in_phase = along.dot(S * along) - ahead.dot(S * ahead), out_of_phase = 2 * along.dot(S * ahead);
  o.lag = 0.5 * std::atan2(out_of_phase, in_phase);
  o.k2 = d * d * d / (orbit.first_mass() * std::pow(orbit.radius_of_ball(), 5)) * std::hypot(in_phase, out_of_phase);
  o.inverse_Q = std::abs(std::sin(2 * o.lag));
  o.torque = orbit.torque(S, s);
  o.spin = mechanics::solve_semidefinite(Eigen::Matrix3d(S.trace() * Eigen::Matrix3d::Identity() - S), J);
  o.obliquity = std::atan2(normal.cross(o.spin).norm(), normal.dot(o.spin));
  o.total_momentum = J + Orbit::momentum(s, sdot);
  return o;
}

}  // namespace pseudorigid::mechanics
