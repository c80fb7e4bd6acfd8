#include "app/continuum/run_compressible.h"

#include "app/continuum/continuum_model.h"

namespace pseudorigid::app {

ModelOutcome run_compressible(const RunContext& context) {
  ContinuumModel<continuum::CompressibleBall> model(context);
  return ModelRun(model, context).run();
}

}  // namespace pseudorigid::app
