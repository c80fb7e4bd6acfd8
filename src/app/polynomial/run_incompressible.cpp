#include "app/polynomial/polynomial_model.h"
#include "app/run/model_run.h"

namespace pseudorigid::app {

ModelOutcome run_incompressible_polynomial(const RunContext& context, const PolynomialTask& task) {
  PolynomialModel<polynomial::IncompressibleBody> model(context, task);
  return ModelRun(model, context, task.stepping).run();
}

}  // namespace pseudorigid::app
