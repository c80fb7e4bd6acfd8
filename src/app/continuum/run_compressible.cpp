#include "app/continuum/run_compressible.h"

#include "app/continuum/continuum_model.h"

namespace pseudorigid::app {

ModelOutcome run_compressible(const RunContext& context, const ContinuumTask& task) {
  ContinuumModel<continuum::CompressibleBall> model(context, task);
  return ModelRun(model, context, task.stepping).run();
}

}  // namespace pseudorigid::app
