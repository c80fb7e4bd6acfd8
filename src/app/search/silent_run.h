#pragma once
/// Runs of a model without files or messages. Their result is the history of Q, which has the affine part Q of the
/// motion at each sample (app/run/deformation_trace.h). A caller can also ask for the stresses.

#include <memory>

#include "app/run/run_context.h"
#include "io/log.h"
#include "scene/entries.h"

namespace pseudorigid::app {

/// Runs the model with `scene`, in which only the section Time may differ from the scene of the context. `task` is the
/// second argument of `run`, for example a ContinuumTask, whose member `trace` receives the history of Q. If `stresses`
/// is not null, it receives the rows of the columns of stress that the scene requests.
template <class Run, class Task>
ModelOutcome run_silently(const Run& run, const RunContext& context, const scene::Scene& scene, const Task& task,
                          io::Table* stresses = nullptr) {
  scene::Needs needs = context.needs;
  needs.graphics = needs.surface_watch = needs.quadrature_error = false;
  for (const auto& [name, member] : scene::quantities_kind.table) needs.quantities.*member = false;
  needs.quantities.stresses = stresses && context.needs.comparison && context.needs.quantities.stresses;
  needs.quantities.volumetric = needs.quantities.second_orbit = needs.quantities.branches = false;
  RunContext silent = derived(context, scene, needs);
  silent.log = io::make_logger(io::Verbosity::silent, {});
  silent.sink_of = [stresses](const RunContext&, const char*) -> std::unique_ptr<ModelSink> {
    if (stresses) return std::make_unique<RowsInMemory>(*stresses);
    return std::make_unique<ModelSink>();
  };
  return run(silent, task);
}

/// Cost of a run, independent of the machine: the number of unknowns times the number of force evaluations. The
/// evaluations in pilot runs are included. The outcome must have the counters `unknowns` and `forces`; otherwise the
/// cost is 0.
inline double work(const ModelOutcome& outcome) {
  const auto& c = outcome.statistics.counters;
  const auto count = [&c](const char* name) { return c.contains(name) ? c.at(name) : 0.0; };
  return count("unknowns") * (count("forces") + count("pilot_forces"));
}

}  // namespace pseudorigid::app
