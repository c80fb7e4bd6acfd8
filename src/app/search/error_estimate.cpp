#include "app/search/error_estimate.h"

#include "analysis/space_error.h"
#include "app/search/time_error.h"

namespace pseudorigid::app {
namespace {

/// Appends all columns but the time to a table with the same times.
void append_columns(const io::Table& columns, io::Table& table) {
  io::Table joined{.columns = table.columns, .values = {}};
  joined.columns.insert(joined.columns.end(), columns.columns.begin() + 1, columns.columns.end());
  for (std::size_t n = 0; n < table.n_rows(); ++n) {
    const auto first = table.row(n), second = columns.row(n).subspan(1);
    joined.values.insert(joined.values.end(), first.begin(), first.end());
    joined.values.insert(joined.values.end(), second.begin(), second.end());
  }
  table = std::move(joined);
}

}  // namespace

analysis::OtherResolution other_resolution(const DeformationTrace& trace, double resolution, double resolution_of_trace,
                                           double least_rate, const RunContext& context) {
  const auto factor = [&](double rate) { return analysis::space_error(1, resolution, resolution_of_trace, rate); };
  return {table_of(trace, context), factor(least_rate), factor(analysis::assumed_stress_rate)};
}

ModelOutcome run_with_companion(const RunContext& context, const CompanionPair& pair, const RunOfPair& run) {
  DeformationTrace trace, other;
  io::Table compared;
  ModelOutcome outcome = run(context, false, {}, &trace);
  auto& counters = outcome.statistics.counters;
  counters["work"] = work(outcome);
  if (outcome.end != mechanics::Outcome::finished) return outcome;
  estimate_time_error(context, pair.model, outcome, trace,
                      [&](const RunContext& silent, const Stepping& stepping, DeformationTrace* other_steps) {
                        return run(silent, false, stepping, other_steps);
                      });
  if (outcome.end != mechanics::Outcome::finished) return outcome;

  const auto run_companion = [&](const RunContext& silent, const std::optional<Stepping>& stepping) {
    return run(silent, true, stepping, &other);
  };
  ModelOutcome companion = run_silently(run_companion, context, context.scene, outcome.stepping, &compared);
  if (companion.end == mechanics::Outcome::interrupted) {
    outcome.end = companion.end;
    outcome.message = "interrupted while the discretisation error was estimated";
    return outcome;
  }
  if (companion.end == mechanics::Outcome::failed) {
    context.log->warn("{}: no estimate of the discretisation error: on {} the {}", pair.model, pair.companion,
                      companion.message);
    return outcome;
  }
  warn_of_gaps(context, pair.model, trace);
  const TraceDifference apart = difference(trace, other);
  const auto error = [&](double d) {
    return analysis::space_error(d, pair.resolution, pair.resolution_of_companion, pair.rate);
  };
  counters["estimated_space_error"] = error(apart.largest);
  counters["relative_space_error"] = error(apart.relative);
  counters["companion_work"] += work(companion);
  outcome.other = other_resolution(other, pair.resolution, pair.resolution_of_companion, pair.least_rate, context);
  if (compared.n_rows() == outcome.other->samples.n_rows()) append_columns(compared, outcome.other->samples);
  const double seconds = companion.statistics.timers["run"];
  outcome.statistics.timers["companion"] += seconds;
  context.log->info("{}: discretisation error of Q {:.1e}, estimated by a run on {} ({:.3g} s)", pair.model,
                    error(apart.largest), pair.companion, seconds);
  return outcome;
}

ModelOutcome run_with_estimate(const RunContext& context, const ContinuumRun& run) {
  const scene::Discretization own = *scene::fixed_discretization(context.scene);
  if (!context.needs.companion) {
    ModelOutcome outcome = run(context, {.discretization = own});
    outcome.statistics.counters["work"] = work(outcome);
    return outcome;
  }
  const scene::Discretization companion = scene::companion(own);
  ModelOutcome outcome =
      run_with_companion(context,
                         {"continuum", scene::resolution(own), scene::resolution(companion), scene::describe(companion),
                          analysis::assumed_space_rate, analysis::least_space_rate},
                         [&](const RunContext& of_run, bool is_companion, const std::optional<Stepping>& stepping,
                             DeformationTrace* trace) {
                           return run(of_run, {is_companion ? companion : own, stepping, trace});
                         });
  if (outcome.other) {
    outcome.statistics.counters["companion_degree"] = companion.degree;
    outcome.statistics.counters["companion_refinements"] = companion.refinements;
  }
  return outcome;
}

}  // namespace pseudorigid::app
