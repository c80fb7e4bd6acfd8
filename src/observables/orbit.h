#pragma once
/// Observables of a body with companions (mechanics/core/orbit.h). The first companion has the mass m, the position r
/// and the velocity v relative to the body. The body has the second moment S and the angular momentum J about its
/// centre. The elements are those of the Kepler orbit of two point masses with r and v (mechanics/core/kepler.h).
///
/// Let n̂ be the unit vector along r × v, r̂ that along r, and t̂ = n̂ × r̂. If r × v = 0, n̂ and t̂ are 0. The lag of
/// the bulge is ½ atan2(2 r̂ᵀS t̂, r̂ᵀS r̂ − t̂ᵀS t̂). The spin ω is that of a rigid body, (tr S Id − S) ω = J, and the
/// obliquity is its angle to n̂.
///
/// The tide of the companion has the potential ½xᵀTx with t̂ᵀT t̂ − r̂ᵀT r̂ = 3Gm/|r|³ in the plane of the orbit. By this
/// tide, a ball of the radius R with the Love number k₂ has the second moment −(k₂R⁵/(3G)) T, up to a multiple of Id.
/// The numbers
///
///   k₂ = (|r|³/(m R⁵)) |q|,   q = r̂ᵀS r̂ − t̂ᵀS t̂ + 2i r̂ᵀS t̂,   1/Q = |Im q|/|q| = |sin(2 lag)|,
///
/// are therefore |k₂| and |Im k₂|/|k₂| at the frequency 2(ω − n) of the tide under five conditions. The orbit is
/// circular with the rate n, and the spin is along n̂. The tide is small, and free oscillations have decayed. The
/// undeformed body is a ball. The bulge of the spin is symmetric about n̂ and does not change q. In other motions k₂
/// and 1/Q are ratios at one time, without a frequency. R is the radius of the ball of the same mass and density.

#include <Eigen/Dense>
#include <cmath>

#include "mechanics/core/orbit.h"
#include "observables/body_observables.h"

namespace pseudorigid::mechanics {

/// Returns the observables for the coordinates s of the companions and their rates sdot. S and J are those of the body.
/// There must be a companion.
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
  o.spin = (S.trace() * Eigen::Matrix3d::Identity() - S).ldlt().solve(J);
  o.obliquity = std::atan2(normal.cross(o.spin).norm(), normal.dot(o.spin));
  o.total_momentum = J + Orbit::momentum(s, sdot);
  return o;
}

}  // namespace pseudorigid::mechanics
