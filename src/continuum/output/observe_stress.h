#pragma once
/// The von Mises stress of the finite-element ball (mechanics/core/von_mises.h) at the Gauss points of the cells. The
/// Cauchy stress is that of the law and of viscoelastic branches. A motion is admissible at these points, so it has a
/// stress there. The pictures have the stress at the nodes (nodal_fields.h).

#include "continuum/body/ball_body.h"
#include "observables/body_observables.h"

namespace pseudorigid::continuum {

/// Sets the mean over the reference ball and the largest value. The value at the centre is that of the mean Cauchy
/// stress at the Gauss points nearest to it. Fails if the deformation is not admissible. Collective.
mechanics::Status observe_stress(const BallBody& ball, const Vector& x, mechanics::StressObservables& observables);

}  // namespace pseudorigid::continuum
