#pragma once
/// The error of the pseudo-rigid model and of polynomial bodies that `pseudorigid check` predicts without a run. The
/// predicted error is the relative error of the frequency of small pulsations of degree 2,
///
///   ω_model/ω_exact − 1.
///
/// The frequencies of the pseudo-rigid ball and of the exact ball are known (app/run/small_pulsation.h). The program
/// computes the frequencies of polynomial bodies of degree N = 3 and 5 (polynomial/rest_modes.h). The sweeps of
/// docs/adequacy.md have tested this prediction for larger motions without spin. At their start, the logarithms of the
/// stretches are at most 0.25 in magnitude, and |L|/2 ≤ 0.75 c/r with L = Q̇Q⁻¹. For other motions there is no
/// prediction.

#include "scene/needs.h"
#include "scene/scene.h"

namespace pseudorigid::app {

/// Adds the predicted errors to needs.expected, if there is a prediction.
void describe_expected_error(const scene::Scene& scene, scene::Needs& needs);

}  // namespace pseudorigid::app
