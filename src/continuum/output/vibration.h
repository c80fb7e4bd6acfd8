#pragma once
/// The energy of vibration of a finite-element ball (observables/vibration.h). The products with the modes are
/// integrals over the cells.

#include "continuum/output/observe.h"
#include "observables/vibration.h"

namespace pseudorigid::continuum {

/// The modes, and the integrals of the product of each modal displacement with each nodal basis function. The integrals
/// are over the cells of this rank.
mechanics::Vibration vibration_of(const BallBody& ball);

/// The energy of vibration and its parts at a state. `known` must contain the centre of mass, its velocity, Q_M, the
/// time derivative of Q_M, and the elastic energy. Collective.
mechanics::VibrationObservables observe_vibration(const BallBody& ball, const mechanics::Vibration& vibration,
                                                  const BallState& state, const mechanics::ContinuumObservables& known);

}  // namespace pseudorigid::continuum
