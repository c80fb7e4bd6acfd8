#pragma once
/// The local tolerance of an adaptive method from a tolerance of the time error of the configuration over a run of
/// length T: pilot runs over a window w ≤ T with local tolerances τ and τ/16 give
///
///   e(τ) = max_k |q_τ(t_k) − q_{τ/16}(t_k)| · (T/w)²,
///
/// for the error of a method without geometric structure grows like t² (its energy drifts; Hairer, Lubich, Wanner,
/// Geometric Numerical Integration, X.3). Then e ~ τ gives the tolerance.
///
/// Round-off grows with the motion, near an unstable point like e^{λt}, and two pilots that leave such a point on the
/// same side by the same rounding error do not show it. So two more pilots are perturbed by round-off after every step,
/// in opposite directions (kicked_method.h), and their distance from the first is part of the estimate. If that is more
/// than the tolerance, and a thousand times what kicks add up to on a regular motion, the run says from which time on.
/// On a regular motion it grows like t^(3/2), since kicks are as often one way as the other.
///
/// A body that rests where kicks do not grow is as right at the end as within the window, and takes no more steps.

#include "mechanics/steps/pilot_run.h"

namespace pseudorigid::mechanics::detail {

/// `compensated`: whether the vectors of the system have compensated sums. n_force grows by the forces of the pilots.
Trial search_tolerance(const StepRequest& request, bool compensated, const AdaptiveMethod& method, long& n_force);

}  // namespace pseudorigid::mechanics::detail
