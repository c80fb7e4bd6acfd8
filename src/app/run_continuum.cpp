#include "app/continuum_model.h"
#include "app/run_compressible.h"
#include "app/run_models.h"
#include "app/run_modes.h"

namespace pseudorigid::app {

ModelOutcome run_continuum(const RunContext& context) {
  if (context.scene.analysis == scene::Analysis::modes) return run_modes(context);
  if (!context.scene.body.incompressible) return run_compressible(context);
  ContinuumModel<continuum::ElasticBall> model(context);
  return ModelRun(model, context).run();
}

}  // namespace pseudorigid::app
