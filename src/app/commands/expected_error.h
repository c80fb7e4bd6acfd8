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
///
/// Figures of an incompressible ball under a weak tide or a slow spin have a bulge in proportion to the Love number h₂.
/// The potential of the tide or of the spin is (T:x⊗x)/2 per mass. Its isotropic part K|x|²/2 with K = tr T/3 holds the
/// surface like gravity. The predicted error of the bulge of the pseudo-rigid model is
///
///   h₂ of the ellipsoid / h₂ of the elastic sphere − 1 = −3/(12.5 + γ'),   γ' = γ + (5/2) K r²/c²,   γ = ρgr/μ,
///
/// with the density ρ, the gravity g at the surface and the shear modulus μ. The largest eigenvalue in magnitude of the
/// deviator of T is s (10 + 0.8 γ') c²/r² with the strength s. In the sweeps of docs/adequacy.md with s up to 0.1 and γ
/// up to 1000, the error differs from this prediction by at most 22 %. Their values of γ' are at least −2. There is
/// no prediction for figures outside these ranges. At γ' = −9.5 the elastic ball loses its stability.

#include "scene/needs.h"
#include "scene/scene.h"

namespace pseudorigid::app {

/// Adds lines with the predicted errors to needs.expected. A motion has the error of the frequency, and an analysis of
/// equilibria has the error of the bulge. Adds nothing for a system other than the ball, for other analyses, or if the
/// scene is outside the ranges above. Also adds nothing for a body without frequencies in app/run/small_pulsation.h.
/// For a sweep of motions, the line is that of the first run, and says so. The line of a motion omits a polynomial body
/// whose frequency cannot be computed.
void describe_expected_error(const scene::Scene& scene, scene::Needs& needs);

}  // namespace pseudorigid::app
