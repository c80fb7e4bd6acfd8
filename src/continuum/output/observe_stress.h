#pragma once
/// The von Mises stress of the finite-element ball (mechanics/core/von_mises.h). The Cauchy stress is that of the law
/// and of viscoelastic branches at the Gauss–Lobatto nodes of each cell. At a node that several cells share, each cell
/// has its own stress. The nodes include the surface and, in the meshes of this program, the centre. The pictures have
/// the same values (nodal_fields.h).

#include "continuum/body/ball_body.h"
#include "observables/body_observables.h"

namespace pseudorigid::continuum {

/// Sets the mean over the reference ball by the Gauss–Lobatto rule, and the largest value at a node. The value at the
/// centre is that of the mean Cauchy stress at the nodes nearest to it. Fails if det F is not positive and finite at a
/// node, or if the law does not admit F there. Collective.
mechanics::Status observe_stress(const BallBody& ball, const Vector& x, mechanics::StressObservables& observables);

}  // namespace pseudorigid::continuum
