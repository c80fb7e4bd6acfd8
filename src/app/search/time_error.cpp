#include "app/search/time_error.h"

#include <cmath>

#include "app/search/silent_run.h"

namespace pseudorigid::app {
namespace {

/// True if the models of the scene are compared, the program chose the steps of this run, and the time error of the run
/// is not known. False if the run or its history of Q lacks the steps or the samples of some intervals.
bool lacks_time_error(const RunContext& context, const ModelOutcome& outcome, const DeformationTrace& trace) {
  const auto n_samples = static_cast<std::size_t>(context.scene.output.samples);
  return context.needs.comparison && outcome.end == mechanics::Outcome::finished &&
         outcome.n_steps.size() == n_samples && trace.size() == n_samples + 1 &&
         !outcome.statistics.counters.contains("estimated_time_error");
}

}  // namespace

void estimate_time_error(const RunContext& context, std::string_view model, ModelOutcome& outcome,
                         const DeformationTrace& trace, const FinerRun& finer) {
  if (!context.ranks->of_first(lacks_time_error(context, outcome, trace))) return;
  constexpr int order = 2;
  Stepping stepping = *outcome.stepping;
  stepping.n_steps = outcome.n_steps;
  for (long& n : stepping.n_steps) n *= 2;
  DeformationTrace fine;
  const auto run = [&](const RunContext& silent, const Stepping& of_run) { return finer(silent, of_run, &fine); };
  const ModelOutcome second = run_silently(run, context, context.scene, stepping);
  auto& statistics = outcome.statistics;
  statistics.counters["companion_work"] += work(second);
  if (second.end == mechanics::Outcome::interrupted) {
    outcome.end = second.end;
    outcome.message = "interrupted while the time error was estimated";
    return;
  }
  if (second.end == mechanics::Outcome::failed) {
    context.log->warn("{}: no estimate of the time error: with twice the steps the {}", model, second.message);
    return;
  }
  const double seconds = second.statistics.timers.at("run");
  statistics.timers["companion"] += seconds;
  const double error = difference(trace, fine).largest / (1 - std::pow(2, -order));
  statistics.counters["estimated_time_error"] = error;
  context.log->info("{}: time error of Q {:.1e}, estimated by a run with twice the steps ({:.3g} s)", model, error,
                    seconds);
  if (const double tolerance = context.scene.time.tolerance; error > tolerance)
    context.log->warn("{}: the time error of this violent motion is above the tolerance of its steps, {:.1e}", model,
                      tolerance);
}

}  // namespace pseudorigid::app
