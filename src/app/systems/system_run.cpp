#include "app/systems/system_run.h"

#include <stdexcept>
#include <utility>
#include <variant>

#include "app/run/model_run.h"
#include "app/run/refuses_method.h"
#include "app/run/run_models.h"
#include "app/systems/equilibria.h"
#include "app/systems/system_model.h"
#include "mechanics/core/declared_dependence.h"
#include "scene/scales.h"
#include "systems/table.h"

namespace pseudorigid::app {
namespace {

std::optional<scene::Refusal> refuses_scene(const systems::AnySystemScene& system, const scene::Scene& scene) {
  if (auto refusal = system.description.refuses(scene)) return refusal;
  if (scene.analysis == scene::Analysis::motion)
    if (auto refusal = scene::refuses_duration(scene.time.end, system.scales(scene).time)) return refusal;
  return std::visit([&](const auto& form) { return refuses_method(scene, form); }, system.model(scene).form());
}

}  // namespace

scene::SystemDescription describe_system(const systems::AnySystemScene& system) {
  scene::SystemDescription description = system.description;
  description.refuses = [system](const scene::Scene& scene) { return refuses_scene(system, scene); };
  return description;
}

ModelOutcome run_system(const systems::AnySystemScene& system, const RunContext& of_program) {
  const systems::Scales scales = system.scales(of_program.scene);
  RunContext context = of_program;
  context.units = {scales.length, scales.mass, scales.time};
  systems::AnyModel model = system.model(of_program.scene);
  return std::visit(
      [&](const auto& form) {
        if (const auto status = mechanics::check_declared_dependence(form, model.start()); !status)
          throw std::logic_error(status.reason());
        if (context.scene.analysis == scene::Analysis::equilibrium)
          return run_equilibria(model.landscape(), mechanics::dissipative(form), model.coordinates(), scales, context);
        SystemModel motion(system.description, form, model, scales, context.scene);
        return ModelRun(motion, context).run();
      },
      model.form());
}

ModelOutcome run_system(const RunContext& context) {
  for (const systems::AnySystemScene& system : systems::system_table())
    if (system.description.name == context.scene.system) return run_system(system, context);
  throw std::logic_error("no system is called " + context.scene.system);
}

}  // namespace pseudorigid::app
