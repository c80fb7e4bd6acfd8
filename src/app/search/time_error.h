#pragma once
/// Estimate of the time error of a violent run. Pilot runs estimate the time error from the start of a run
/// (mechanics/steps/step_size.h). If an interval between samples is integrated again, the pilot runs did not see the
/// largest errors, and the run drops their estimate. Finite elements also drop it if det F falls to 0.8. A run on the
/// same discretisation with twice the steps in every interval then gives the estimate
///
///   e = max_t max_ij |Q_ij − Q'_ij| / (1 − 2^−p),   p = 2,
///
/// with the affine parts Q and Q' of both motions. All methods have at least this order p if the motion is smooth.

#include <functional>
#include <optional>
#include <string_view>

#include "app/run/deformation_trace.h"
#include "app/run/run_context.h"

namespace pseudorigid::app {

/// Runs the scene without files and messages, with the given method and steps. `trace` receives the history of Q.
using FinerRun =
    std::function<ModelOutcome(const RunContext& context, const Stepping& stepping, DeformationTrace* trace)>;

/// Estimates the time error of a run if the models are compared, the program chose the steps, and the error is not
/// known. Runs the scene with twice the steps by `finer`, and sets the counter estimated_time_error of `outcome`.
/// `trace` is the history of Q of the run. If the second run fails, a warning says so, and the error stays unknown. If
/// it is interrupted, `outcome` becomes interrupted. Logs a warning if the estimate is above the tolerance of the
/// steps. Adds to the counter companion_work and to the timer of companion runs. Collective.
void estimate_time_error(const RunContext& context, std::string_view model, ModelOutcome& outcome,
                         const DeformationTrace& trace, const FinerRun& finer);

}  // namespace pseudorigid::app
