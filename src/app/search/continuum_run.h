#pragma once
/// A scene may need several runs of the continuum: the one whose results are written, and others whose trace alone is
/// needed. The latter have no observables, no files and no messages.

#include <functional>
#include <optional>

#include "app/run/run_context.h"
#include "app/search/deformation_trace.h"
#include "io/log.h"
#include "scene/discretization.h"
#include "scene/entries.h"

namespace pseudorigid::app {

struct ContinuumTask {
  scene::Discretization discretization;
  std::optional<Stepping> stepping{};  ///< found by another run, in place of a search
  DeformationTrace* trace = nullptr;   ///< where the run leaves Q as it goes, if anybody asks
};

using ContinuumRun = std::function<ModelOutcome(const RunContext& context, const ContinuumTask& task)>;

/// `scene`: that of the context, but for what may differ in its section Time.
inline ModelOutcome run_silently(const ContinuumRun& run, const RunContext& context, const scene::Scene& scene,
                                 const ContinuumTask& task) {
  scene::Needs needs = context.needs;
  needs.graphics = needs.surface_watch = false;
  for (const auto& [name, member] : scene::quantities_kind.table) needs.quantities.*member = false;
  RunContext silent = derived(context, scene, needs);
  silent.log = io::make_logger(io::Verbosity::silent, {});
  silent.sink_of = [](const RunContext&, const char*) { return std::make_unique<ModelSink>(); };
  return run(silent, task);
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
