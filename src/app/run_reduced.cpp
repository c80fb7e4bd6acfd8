#include "app/run_models.h"

#include "app/model_run.h"
#include "app/reduced_model.h"

namespace pseudorigid::app {
namespace {

template <class Body>
ModelOutcome run_body(Body body, const RunContext& context) {
  ReducedModel<Body> model(std::move(body), context);
  return ModelRun(model, context).run();
}

}  // namespace

ModelOutcome run_reduced(const RunContext& context) {
  const auto ball = reduced::ReferenceBody::unit_ball();
  return std::visit(
      [&](const auto& law) {
        using Law = std::decay_t<decltype(law)>;
        return context.scene.body.incompressible ? run_body(reduced::PseudoRigidBody<Law, true>(law, ball), context)
                                                 : run_body(reduced::PseudoRigidBody<Law, false>(law, ball), context);
      },
      internal_law(context.scene));
}

}  // namespace pseudorigid::app
