#pragma once
/// The error of the pseudo-rigid model and of polynomial bodies that `pseudorigid check` predicts without a run. It is
/// the relative error of the frequency of small pulsations of degree 2,
///
///   ω_model/ω_exact − 1.
///
/// The frequencies of the pseudo-rigid ball and of the exact ball are known (app/run/small_pulsation.h). The program
/// computes the frequencies of polynomial bodies with N = 3 and 5 (polynomial/rest_modes.h). The sweeps of
/// docs/adequacy.md have tested this prediction for larger motions without spin. They have amplitudes of the logarithm
/// of a stretch up to 0.25, and strain rates up to 0.75 c/r. For larger motions there is no prediction.

#include "scene/needs.h"
#include "scene/scene.h"

namespace pseudorigid::app {

void describe_expected_error(const scene::Scene& scene, scene::Needs& needs);

}  // namespace pseudorigid::app
