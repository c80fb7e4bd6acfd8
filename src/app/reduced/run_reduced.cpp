#include "app/run/run_models.h"

#include "app/reduced/ball_equilibria.h"
#include "app/reduced/reduced_scene.h"
#include "app/reduced/run_reduced_form.h"
#include "app/reduced/static_equilibria.h"
#include "app/run/love_table.h"

namespace pseudorigid::app {

ModelOutcome run_reduced(const RunContext& context) {
  if (scene::finds_static_equilibria(context.scene)) return run_static_equilibria(context);
  if (context.scene.analysis == scene::Analysis::equilibrium) return run_ball_equilibria(context);
  if (context.scene.analysis == scene::Analysis::love_numbers) return run_reduced_love_numbers(context);
  const ReducedScene scene = reduced_scene(context.scene);
  switch (form_of(scene)) {
    case ReducedForm::elastic:
      return run_reduced_form<ReducedForm::elastic>(scene, context);
    case ReducedForm::general:
      return run_reduced_form<ReducedForm::general>(scene, context);
    case ReducedForm::diagonal:
      return run_reduced_form<ReducedForm::diagonal>(scene, context);
    case ReducedForm::dissipative:
      return run_reduced_form<ReducedForm::dissipative>(scene, context);
    case ReducedForm::loaded:
      return run_reduced_form<ReducedForm::loaded>(scene, context);
  }
  return {};
}

}  // namespace pseudorigid::app
