#pragma once
/// The energy of vibration of a finite-element ball (observables/vibration.h). The products with the modes are
/// integrals over the cells.

#include "continuum/output/observe.h"
#include "observables/vibration.h"

namespace pseudorigid::continuum {

/// Returns the modes, the reference positions of the nodes of this rank and of its ghost nodes, and the nodal masses,
/// which are 0 at ghost nodes. The result also contains the integrals over the cells of this rank of each modal
/// displacement times each nodal basis function.
mechanics::Vibration vibration_of(const BallBody& ball);

/// The energy of vibration of the whole ball at a state, and its parts by degree. `known` must contain the centre of
/// mass, its velocity, Q_M, the time derivative of Q_M, and the elastic energy. Collective.
mechanics::VibrationObservables observe_vibration(const BallBody& ball, const mechanics::Vibration& vibration,
                                                  const BallState& state, const mechanics::ContinuumObservables& known);

}  // namespace pseudorigid::continuum
