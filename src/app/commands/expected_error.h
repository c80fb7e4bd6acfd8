#pragma once
/// The error of the pseudo-rigid model and of polynomial bodies that `pseudorigid check` expects before anything runs.
/// It is the error of the frequency of small pulsations of degree 2,
///
///   ω_model/ω_exact − 1,
///
/// exact for the pseudo-rigid ball (app/run/small_pulsation.h) and computed for N = 3 and 5 (polynomial/rest_modes.h).
/// The sweeps of docs/adequacy.md have tried it for larger motions: up to the amplitude 0.25 of a stretch's logarithm,
/// and strain rates up to 0.75 c/r, without spin. It is silent beyond that.

#include "scene/needs.h"
#include "scene/scene.h"

namespace pseudorigid::app {

void describe_expected_error(const scene::Scene& scene, scene::Needs& needs);

}  // namespace pseudorigid::app
