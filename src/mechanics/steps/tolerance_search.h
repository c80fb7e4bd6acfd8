#pragma once
/// The search for the local tolerance of an adaptive method, which is the tolerance of a single step. The requested
/// tolerance applies to the time error of the configuration over a run of length T. Pilot runs over a window w ≤ T with
/// local tolerances τ and τ/16 give the estimate
///
///   e(τ) = max_k |q_τ(t_k) − q_{τ/16}(t_k)| · (T/w)²,
///
/// with the configuration q_τ for the local tolerance τ, and the samples t_k. The factor (T/w)² is used because the
/// error of a method without geometric structure grows like t², since its energy drifts (Hairer, Lubich, Wanner,
/// Geometric Numerical Integration, X.3). The relation e ~ τ then gives τ.
///
/// Round-off also grows with the motion, for example like e^{λt} near an unstable point with the growth rate λ. If both
/// pilot runs have the same rounding errors, their difference does not show this growth. If force evaluations are
/// cheap, the search therefore makes two more pilot runs. These runs are perturbed by round-off after every step, in
/// opposite directions (kicked_method.h). Their distance from the run with tolerance τ is part of the estimate. On a
/// regular motion this distance grows like t^(3/2), because the perturbations have irregular signs. If the distance is
/// more than a thousand times as large as on a regular motion, the motion is considered to amplify round-off. The
/// result then contains the first time at which the distance exceeds (w/T)² times the requested tolerance, if there is
/// such a time within the window.
///
/// A system at rest that does not amplify perturbations is assumed to remain at rest. Its error and its number of force
/// evaluations are not extrapolated from the window to the run.

#include "mechanics/steps/pilot_run.h"

namespace pseudorigid::mechanics::detail {

/// Searches for the local tolerance and returns the result. The verdict is `failed` if a pilot run fails, or if none of
/// six local tolerances gives the required error. The least τ, 64 units of round-off, is accepted with any error. If
/// e(τ) is above half of the requested tolerance when τ is accepted, the result is τ/16, and otherwise τ. `compensated`
/// is true if sums of the system's vectors are compensated (vector_space.h). The function adds the number of force
/// evaluations of its pilot runs to n_force.
Trial search_tolerance(const StepRequest& request, bool compensated, const AdaptiveMethod& method, long& n_force);

}  // namespace pseudorigid::mechanics::detail
