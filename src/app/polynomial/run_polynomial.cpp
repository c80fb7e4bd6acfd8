#include "app/polynomial/degree_search.h"
#include "app/polynomial/polynomial_model.h"
#include "app/polynomial/run_equilibria.h"
#include "app/polynomial/run_love_numbers.h"
#include "app/polynomial/run_modes.h"
#include "app/run/model_run.h"
#include "app/run/run_models.h"

namespace pseudorigid::app {
namespace {

template <class Body>
ModelOutcome run_model(const RunContext& context, const PolynomialTask& task) {
  return run_from_start([&] {
    PolynomialModel<Body> model(context, task);
    return ModelRun(model, context, task.stepping).run();
  });
}

/// Runs the motion of a body once. It is an IncompressibleBody if the body is incompressible, or if its bulk term is
/// projected.
ModelOutcome run_body(const RunContext& context, const PolynomialTask& task) {
  return context.needs.pressure_space ? run_model<polynomial::IncompressibleBody>(context, task)
                                      : run_model<polynomial::CompressibleBody>(context, task);
}

}  // namespace

ModelOutcome run_polynomial(const RunContext& context) {
  if (context.scene.analysis == scene::Analysis::modes) return run_polynomial_modes(context);
  if (context.scene.analysis == scene::Analysis::love_numbers) return run_polynomial_love_numbers(context);
  if (context.scene.analysis == scene::Analysis::equilibrium) return run_polynomial_equilibria(context);
  const std::vector<int>& degrees = context.scene.polynomial.degrees;
  return degrees.empty() ? run_degree_search(context, run_body) : run_listed_degrees(context, run_body);
}

}  // namespace pseudorigid::app
