#include "app/polynomial/polynomial_model.h"
#include "app/run/model_run.h"

namespace pseudorigid::app {

ModelOutcome run_compressible_polynomial(const RunContext& context, const PolynomialTask& task) {
  PolynomialModel<polynomial::CompressibleBody> model(context, task);
  return ModelRun(model, context, task.stepping).run();
}

}  // namespace pseudorigid::app
