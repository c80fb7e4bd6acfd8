#pragma once
/// Observables of a body with companions (mechanics/core/orbit.h). The first companion has the mass m, and the position
/// r and velocity v relative to the centre of mass of the body. About this centre, the body has the second moment of
/// mass S and the angular momentum J. The elements are those of the Kepler orbit of two point masses with r and v
/// (mechanics/core/kepler.h).
///
/// Let n̂ and r̂ be the unit vectors along r × v and r, and t̂ = n̂ × r̂. If r × v = 0, n̂ and t̂ are 0. The lag of the
/// bulge is ½ atan2(2 r̂ᵀS t̂, r̂ᵀS r̂ − t̂ᵀS t̂). The spin ω is the angular velocity of a rigid body with the same S
/// and J, so (tr S Id − S) ω = J. The obliquity is the angle between ω and n̂.
///
/// The tide of the companion has the potential energy ½xᵀTx per mass, with t̂ᵀT t̂ − r̂ᵀT r̂ = 3Gm/|r|³ and the
/// gravitational constant G. This tide changes the second moment of a ball of the radius R with the Love number k₂ by
/// −(k₂R⁵/(3G)) T, up to a multiple of Id. The numbers
///
///   k₂ = (|r|³/(m R⁵)) |q|,   q = r̂ᵀS r̂ − t̂ᵀS t̂ + 2i r̂ᵀS t̂,   1/Q = |Im q|/|q| = |sin(2 lag)|,
///
/// are therefore |k₂| and |Im k₂|/|k₂| at the frequency 2(ω − n) of the tide under five conditions. The orbit is
/// circular with the angular velocity n. The spin is along n̂. The tide is small. The free oscillations have decayed.
/// The undeformed body is a ball. The bulge due to the spin is symmetric about n̂ and does not change q. In other
/// motions, k₂ and 1/Q describe the shape at one time and do not belong to a frequency. R is the radius of a ball with
/// the mass and the density of the body.

#include <Eigen/Core>

#include "mechanics/core/orbit.h"
#include "observables/body_observables.h"

namespace pseudorigid::mechanics {

/// Returns the observables for the coordinates s_k of the companions and their rates (the columns of `s` and `sdot`,
/// mechanics/core/orbit.h). S and J are those of the body. There must be at least one companion.
OrbitObservables observe_orbit(const Orbit& orbit, const Orbit::Columns& s, const Orbit::Columns& sdot,
                               const Eigen::Matrix3d& S, const Eigen::Vector3d& J);

}  // namespace pseudorigid::mechanics
