#pragma once
/// Description of one run of the finite-element model. A scene may need several runs. Some runs write results. The
/// other runs do not write observables, files or messages. They only give the history of Q, the values of the affine
/// part Q of the motion at the samples. Q is a 3×3 matrix.

#include <functional>
#include <optional>
#include <string_view>

#include "app/run/deformation_trace.h"
#include "app/run/run_context.h"
#include "app/search/silent_run.h"
#include "scene/discretization.h"

namespace pseudorigid::app {

/// The discretisation of a run, its method and step, and the destination of its history of Q.
struct ContinuumTask {
  scene::Discretization discretization;
  std::optional<Stepping> stepping{};  ///< method and step of another run; if empty, the run chooses its own
  DeformationTrace* trace = nullptr;   ///< receives the history of Q; null if the history is not requested
};

/// Runs the finite-element model once for the scene and the sink of the context. Collective.
using ContinuumRun = std::function<ModelOutcome(const RunContext& context, const ContinuumTask& task)>;

/// Warns if the history of Q does not have all samples. A resumed run reads the earlier Q from `<model>.csv`. If this
/// file lacks the columns of Q, the history lacks the earlier samples, and the error estimate covers only a part of the
/// run.
inline void warn_of_gaps(const RunContext& context, std::string_view model, const DeformationTrace& trace) {
  if (trace.size() <= static_cast<std::size_t>(context.scene.output.samples))
    context.log->warn(
        "{}: the discretisation error is estimated from {} of {} samples: {}.csv has no Q from before the resume, as "
        "Output/Quantities lacks state",
        model, trace.size(), context.scene.output.samples + 1, model);
}

}  // namespace pseudorigid::app
