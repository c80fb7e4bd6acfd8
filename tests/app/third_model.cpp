/// A program with a third model of the ball beside its two: the pseudo-rigid body under another name. It is all that a
/// new model takes: a description, a function that runs it, and a place in the table.

#include "app/commands/program.h"
#include "app/models/ball_models.h"
#include "app/reduced/reduced_model.h"
#include "app/run/model_run.h"
#include "app/run/run_models.h"

namespace pseudorigid::app {
namespace {

constexpr const char* name = "copy";

ModelOutcome run_copy(const RunContext& context) {
  const ReducedScene scene = reduced_scene(context.scene);
  ReducedModel model(general_body<true>(scene), scene, context, name);
  return ModelRun(model, context).run();
}

BallModel copy_model() {
  scene::ModelDescription copy = reduced_model().description;
  copy.name = name;
  copy.adjective = "copied";
  copy.documentation = "The pseudo-rigid body once more.";
  copy.by_default = false;
  copy.has_equilibria = false;
  copy.static_equilibria = nullptr;
  copy.needed = [](const scene::Scene&) { return "copy: the pseudo-rigid body once more"; };
  copy.skipped = [](const scene::Scene&) { return "copy: not among Models"; };
  return {copy, run_copy};
}

}  // namespace
}  // namespace pseudorigid::app

int main(int argc, char** argv) {
  using namespace pseudorigid::app;
  std::vector<BallModel> models = ball_models();
  models.insert(models.begin(), copy_model());
  return run_program(argc, argv, {.models = models, .open_continuum = pseudorigid_continuum});
}
