#pragma once
/// Observables of a body with companions (mechanics/core/orbit.h). The first companion has the position r and the
/// velocity v relative to the body. The body has the second moment S and the angular momentum J about its centre. With
/// g = G(M + m_1), the Kepler orbit of two point masses has
///
///   1/a = 2/|r| − |v|²/g,   e = |v × (r × v)/g − r̂|.
///
/// With n̂ along r × v and t̂ = n̂ × r̂, the lag of the bulge is the angle ½ atan2(2 r̂ᵀS t̂, r̂ᵀS r̂ − t̂ᵀS t̂). The spin ω is
/// that of a rigid body, (tr S Id − S) ω = J.

#include <Eigen/Dense>
#include <cmath>

#include "mechanics/core/orbit.h"
#include "observables/body_observables.h"

namespace pseudorigid::mechanics {

/// The observables for the coordinates s of the companions, and their rates.
inline OrbitObservables observe_orbit(const Orbit& orbit, const Orbit::Columns& s, const Orbit::Columns& sdot,
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
  const double g = orbit.gravity_of_pair(), d = r.norm(), by_a = 2 / d - v.squaredNorm() / g;
  const Eigen::Vector3d along = r / d, across = r.cross(v);
  o.semi_major_axis = by_a == 0 ? 0 : 1 / by_a;
  o.eccentricity = (v.cross(across) / g - along).norm();
  const Eigen::Vector3d ahead =
      across.isZero(0) ? Eigen::Vector3d::Zero().eval() : across.normalized().cross(along).eval();
  o.lag = 0.5 * std::atan2(2 * along.dot(S * ahead), along.dot(S * along) - ahead.dot(S * ahead));
  o.torque = orbit.torque(S, s);
  o.spin = (S.trace() * Eigen::Matrix3d::Identity() - S).ldlt().solve(J);
  o.total_momentum = J + Orbit::momentum(s, sdot);
  return o;
}

}  // namespace pseudorigid::mechanics
