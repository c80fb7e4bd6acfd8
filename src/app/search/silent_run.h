#pragma once
/// Runs of a model without files or messages. Their result is the history of Q, which has the affine part Q of the
/// motion at each sample (app/run/deformation_trace.h). A caller can also ask for the other compared quantities.

#include <memory>

#include "app/run/run_context.h"
#include "io/log.h"
#include "scene/entries.h"

namespace pseudorigid::app {

/// The groups of columns, apart from Q, whose differences a comparison of the models contains.
inline constexpr bool mechanics::Quantities::*compared_groups[]{
    &mechanics::Quantities::energies, &mechanics::Quantities::momenta,   &mechanics::Quantities::multiplier,
    &mechanics::Quantities::axes,     &mechanics::Quantities::nonaffine, &mechanics::Quantities::stretches,
    &mechanics::Quantities::stresses};

/// Runs the model with `scene`, in which only the section Time may differ from the scene of the context. `task` is the
/// second argument of `run`, for example a ContinuumTask, whose member `trace` receives the history of Q. If `compared`
/// is not null and the models are compared, it receives the rows of the compared groups that the scene requests.
template <class Run, class Task>
ModelOutcome run_silently(const Run& run, const RunContext& context, const scene::Scene& scene, const Task& task,
                          io::Table* compared = nullptr) {
  scene::Needs needs = context.needs;
  needs.graphics = needs.surface_watch = needs.quadrature_error = false;
  for (const auto& [name, member] : scene::quantities_kind.table) needs.quantities.*member = false;
  if (compared && context.needs.comparison)
    for (const auto group : compared_groups) needs.quantities.*group = context.needs.quantities.*group;
  needs.quantities.volumetric = needs.quantities.second_orbit = needs.quantities.branches = false;
  RunContext silent = derived(context, scene, needs);
  silent.log = io::make_logger(io::Verbosity::silent, {});
  silent.sink_of = [compared](const RunContext&, const char*) -> std::unique_ptr<ModelSink> {
    if (compared) return std::make_unique<RowsInMemory>(*compared);
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
