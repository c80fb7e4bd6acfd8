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

#include <Eigen/Core>

#include "mechanics/core/orbit.h"
#include "observables/body_observables.h"

namespace pseudorigid::mechanics {

/// Returns the observables for the coordinates s of the companions and their rates sdot. S and J are those of the body.
/// There must be a companion.
OrbitObservables observe_orbit(const Orbit& orbit, const Orbit::Columns& s, const Orbit::Columns& sdot,
                               const Eigen::Matrix3d& S, const Eigen::Vector3d& J);

}  // namespace pseudorigid::mechanics
