#include "app/continuum/continuum_model.h"
#include "app/continuum/run_equilibria.h"
#include "app/continuum/run_love_numbers.h"
#include "app/continuum/run_modes.h"
#include "app/run/run_models.h"
#include "app/search/discretization_search.h"
#include "app/search/error_estimate.h"

namespace pseudorigid::app {
namespace {

template <class Ball>
ModelOutcome run_model(const RunContext& context, const ContinuumTask& task) {
  return run_from_start([&] {
    ContinuumModel<Ball> model(context, task);
    return ModelRun(model, context, task.stepping).run();
  });
}

/// Runs the motion of the ball once. It is an ElasticBall if the body is incompressible, or if its bulk term is
/// projected.
ModelOutcome run_ball(const RunContext& context, const ContinuumTask& task) {
  return context.needs.pressure_space ? run_model<continuum::ElasticBall>(context, task)
                                      : run_model<continuum::CompressibleBall>(context, task);
}

}  // namespace

ModelOutcome run_continuum(const RunContext& context) {
  if (context.scene.analysis == scene::Analysis::modes) return run_modes(context);
  if (context.scene.analysis == scene::Analysis::equilibrium) return run_continuum_equilibria(context);
  if (context.scene.analysis == scene::Analysis::love_numbers) return run_continuum_love_numbers(context);
  return scene::fixed_discretization(context.scene) ? run_with_estimate(context, run_ball)
                                                    : DiscretizationSearch(context, run_ball).run();
}

}  // namespace pseudorigid::app
