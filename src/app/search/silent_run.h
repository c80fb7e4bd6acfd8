#pragma once
/// A run of the continuum for its trace alone: no observables, no files, no words.

#include <functional>

#include "app/run/run_context.h"
#include "io/log.h"
#include "scene/entries.h"

namespace pseudorigid::app {

/// The continuum on the discretisation that its context names.
using ContinuumRun = std::function<ModelOutcome(const RunContext& context)>;

/// `scene`: that of the context, but for what may differ in its section Time.
inline ModelOutcome run_silently(const ContinuumRun& run, const RunContext& context, const scene::Scene& scene,
                                 const scene::Discretization& discretization,
                                 const std::optional<KnownStepping>& stepping, DeformationTrace& trace) {
  scene::Needs needs = context.needs;
  needs.graphics = false;
  for (const auto& [name, member] : scene::quantities_kind.table) needs.quantities.*member = false;
  io::Table rows;
  RunContext silent = derived(context, scene, needs);
  silent.log = io::make_logger(io::Verbosity::silent, {});
  silent.resume = false;
  silent.rows = &rows;
  silent.discretization = discretization;
  silent.stepping = stepping;
  silent.trace = &trace;
  return run(silent);
}

/// A resumed run knows Q before its resume from the columns of continuum.csv alone.
inline void warn_of_gaps(const RunContext& context, const DeformationTrace& trace) {
  if (trace.size() <= static_cast<std::size_t>(context.scene.output.samples))
    context.log->warn(
        "continuum: the discretisation error is estimated from {} of {} samples: of the time before the "
        "resume Q is not in continuum.csv, as Output/Quantities has no state",
        trace.size(), context.scene.output.samples + 1);
}

/// Unknowns times evaluations of the force, those of pilots included: what a run has cost, whatever the machine.
inline double work(const ModelOutcome& outcome) {
  const auto& c = outcome.statistics.counters;
  const auto count = [&c](const char* name) { return c.contains(name) ? c.at(name) : 0.0; };
  return count("unknowns") * (count("forces") + count("pilot_forces"));
}

}  // namespace pseudorigid::app
