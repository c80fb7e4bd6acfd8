#pragma once
/// The search for the local tolerance of an adaptive method. The given tolerance applies to the time error of the
/// configuration over a run of length T. Pilot runs over a window w ≤ T with local tolerances τ and τ/16 give the
/// estimate
///
///   e(τ) = max_k |q_τ(t_k) − q_{τ/16}(t_k)| · (T/w)²,
///
/// because the error of a method without geometric structure grows like t²: its energy drifts (Hairer, Lubich, Wanner,
/// Geometric Numerical Integration, X.3). The relation e ~ τ then gives τ.
///
/// Round-off grows with the motion, near an unstable point like e^{λt}. Two pilot runs with the same rounding errors do
/// not show this growth. Therefore, unless forces are costly, two more pilot runs are perturbed by round-off after
/// every step, in opposite directions (kicked_method.h). Their distance from the first pilot run is part of the
/// estimate. On a regular motion the distance grows like t^(3/2), since the perturbations have random signs. If it is
/// more than a thousand times as large as on a regular motion, the motion amplifies round-off. The result then has the
/// time after which round-off exceeds the tolerance.
///
/// For a body at rest that does not amplify perturbations, the error and the number of steps do not grow after the
/// window.

#include "mechanics/steps/pilot_run.h"

namespace pseudorigid::mechanics::detail {

/// `compensated` is true if sums of the system's vectors are compensated. Adds the forces of the pilot runs to n_force.
Trial search_tolerance(const StepRequest& request, bool compensated, const AdaptiveMethod& method, long& n_force);

}  // namespace pseudorigid::mechanics::detail
