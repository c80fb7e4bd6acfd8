#pragma once
/// The gravity between companions (mechanics/core/orbit.h) and the nodes of the finite-element ball, without expansion
/// in the size of the ball. Node n has the mass m_n and the position y_n relative to the centre of mass. Companion i
/// has the mass m_i and the position r_i relative to this centre. With the gravitational constant G, the energy and the
/// forces are
///
///   U = −Σ_i Σ_n G m_i m_n/|r_i − y_n|,   F_i = −∂U/∂r_i,   f_n = −∂U/∂y_n + (m_n/M) Σ_i F_i,
///
/// with the mass M of the ball. The resultant of the forces −∂U/∂y_n is −Σ_i F_i. The last term of f_n removes this
/// resultant, because the motion of the centre of mass of the ball is a part of Jacobi's coordinates of the companions.
/// The nodes are the points of the Gauss–Lobatto rule with the weights m_n.

#include "continuum/mesh/ball_space.h"
#include "mechanics/core/orbit.h"

namespace pseudorigid::continuum {

/// Energy, forces and torque of the gravity between the ball and its companions, as sums over the nodes of the whole
/// ball.
struct CompanionSums {
  double energy = 0;                        ///< energy U
  mechanics::Orbit::Columns on_companions;  ///< forces F_i, one column for each companion
  Eigen::Vector3d torque{0, 0, 0};          ///< torque on the ball about its centre of mass
};

/// Computes the sums for the position x of the ball with the centre of mass `center`. Column i of r is r_i. Collective.
CompanionSums companion_sums(const mechanics::Orbit& orbit, const BallSpace& space, const Vector& x,
                             const Eigen::Vector3d& center, const mechanics::Orbit::Columns& r);

/// f ← f + f_n at the nodes of this rank. `sums` must be the result of companion_sums for the same arguments, and
/// `mass` is M.
void add_companion_forces(const mechanics::Orbit& orbit, const BallSpace& space, const Vector& x,
                          const Eigen::Vector3d& center, const mechanics::Orbit::Columns& r, const CompanionSums& sums,
                          double mass, Vector& f);

}  // namespace pseudorigid::continuum
