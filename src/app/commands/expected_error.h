#pragma once
/// The error of the pseudo-rigid model and of polynomial bodies that `pseudorigid check` predicts without a run. Small
/// motions about rest have modes, and the slowest pulsation is a spheroidal mode of degree 2. The predicted error is
/// the relative error of the frequency of this mode,
///
///   ω_model/ω_exact − 1,
///
/// with the angular frequencies ω_model of the model and ω_exact of the elastic ball. For the pseudo-rigid model,
/// app/run/small_pulsation.h gives both frequencies. For polynomial bodies of degree N = 3 and 5,
/// polynomial/rest_modes.h computes ω_model. The sweeps of docs/adequacy.md have tested this prediction for larger
/// motions without spin. At their start, the logarithms of the stretches are at most 0.25 in magnitude. The velocity
/// gradient L = Q̇Q⁻¹, with the deformation Q, is symmetric. Its Frobenius norm is at most 1.5 c/r, with the speed c of
/// shear waves and the radius r. For other motions there is no prediction.

#include "scene/needs.h"
#include "scene/scene.h"

namespace pseudorigid::app {

/// Adds a line with the predicted errors to needs.expected. Adds nothing for a system other than the ball, or for an
/// analysis other than motion. Also adds nothing for a body without frequencies in app/run/small_pulsation.h, or if the
/// initial state is outside the range above. The line omits a polynomial body whose frequency cannot be computed.
void describe_expected_error(const scene::Scene& scene, scene::Needs& needs);

}  // namespace pseudorigid::app
