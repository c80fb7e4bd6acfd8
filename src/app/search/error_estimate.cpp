#include "app/search/error_estimate.h"

#include "analysis/space_error.h"

namespace pseudorigid::app {

ModelOutcome run_with_estimate(const RunContext& context, const ContinuumRun& run) {
  const scene::Discretization discretization = *scene::fixed_discretization(context.scene);
  DeformationTrace trace, coarse;
  ModelOutcome outcome =
      run(context, {.discretization = discretization, .trace = context.needs.companion ? &trace : nullptr});
  auto& counters = outcome.statistics.counters;
  counters["work"] = work(outcome);
  if (!context.needs.companion || outcome.end != mechanics::Outcome::finished) return outcome;

  const scene::Discretization other = scene::companion(discretization);
  ModelOutcome companion = run_silently(run, context, context.scene, ContinuumTask{other, outcome.stepping, &coarse});
  if (companion.end == mechanics::Outcome::interrupted) {
    outcome.end = companion.end;
    outcome.message = "interrupted while the discretisation error was estimated";
    return outcome;
  }
  if (companion.end == mechanics::Outcome::failed) {
    context.log->warn("continuum: no estimate of the discretisation error: on {} the {}", scene::describe(other),
                      companion.message);
    return outcome;
  }
  warn_of_gaps(context, trace);
  const TraceDifference apart = difference(trace, coarse);
  const auto error = [&](double d) {
    return analysis::space_error(d, scene::resolution(discretization), scene::resolution(other));
  };
  counters["estimated_space_error"] = error(apart.largest);
  counters["relative_space_error"] = error(apart.relative);
  counters["companion_degree"] = other.degree;
  counters["companion_refinements"] = other.refinements;
  counters["companion_work"] = work(companion);
  const double seconds = outcome.statistics.timers["companion"] = companion.statistics.timers["run"];
  context.log->info("continuum: discretisation error of Q {:.1e}, estimated by a run on {} ({:.3g} s)",
                    error(apart.largest), scene::describe(other), seconds);
  return outcome;
}

}  // namespace pseudorigid::app
