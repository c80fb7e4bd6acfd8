#include "app/reduced/ball_equilibria.h"
#include "app/reduced/reduced_model.h"
#include "app/reduced/reduced_scene.h"
#include "app/reduced/static_equilibria.h"
#include "app/run/love_table.h"
#include "app/run/model_run.h"
#include "app/run/run_models.h"

namespace pseudorigid::app {
namespace {

/// Runs the motion of the body in this form. The form must contain all forces of the scene (form_of). All forms are in
/// this file, because they share instantiations: with a file for each form, the compiler takes almost twice as long.
template <ReducedForm form, bool incompressible>
ModelOutcome run_form(const ReducedScene& scene, const RunContext& context) {
  ReducedModel model(system_of<form, incompressible>(scene), scene, context);
  return ModelRun(model, context).run();
}

template <bool incompressible>
ModelOutcome run_motion(const ReducedScene& scene, const RunContext& context) {
  switch (form_of(scene)) {
    case ReducedForm::elastic:
      return run_form<ReducedForm::elastic, incompressible>(scene, context);
    case ReducedForm::general:
      return run_form<ReducedForm::general, incompressible>(scene, context);
    case ReducedForm::diagonal:
      return run_form<ReducedForm::diagonal, incompressible>(scene, context);
    case ReducedForm::dissipative:
      return run_form<ReducedForm::dissipative, incompressible>(scene, context);
    case ReducedForm::loaded:
      return run_form<ReducedForm::loaded, incompressible>(scene, context);
  }
  return {};
}

}  // namespace

ModelOutcome run_reduced(const RunContext& context) {
  if (scene::finds_static_equilibria(context.scene)) return run_static_equilibria(context);
  if (context.scene.analysis == scene::Analysis::equilibrium) return run_ball_equilibria(context);
  if (context.scene.analysis == scene::Analysis::love_numbers) return run_reduced_love_numbers(context);
  const ReducedScene scene = reduced_scene(context.scene);
  return context.scene.body.incompressible ? run_motion<true>(scene, context) : run_motion<false>(scene, context);
}

}  // namespace pseudorigid::app
