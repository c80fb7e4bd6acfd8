#include "app/systems/system_run.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>
#include <variant>

#include "app/run/model_run.h"
#include "app/run/refuses_method.h"
#include "app/run/run_models.h"
#include "app/systems/equilibria.h"
#include "app/systems/manifolds.h"
#include "app/systems/section.h"
#include "app/systems/system_model.h"
#include "mechanics/core/declared_dependence.h"
#include "scene/scales.h"
#include "systems/table.h"

namespace pseudorigid::app {
namespace {

/// The reason why the program cannot run the scene; empty if there is none. The reason can be an entry of the system,
/// the duration or the method. It can also be a negative Time/End for a system that cannot run backwards in time.
std::optional<scene::Refusal> refuses_scene(const systems::AnySystemScene& system, const scene::Scene& scene) {
  if (auto refusal = system.description.refuses(scene)) return refusal;
  using enum scene::Analysis;
  if (scene.analysis != equilibrium)
    if (auto refusal = scene::refuses_duration(std::abs(scene.time.end), system.scales(scene).time)) return refusal;
  const std::string_view method = scene.time.method;
  if ((scene.analysis == manifolds || scene.analysis == section) && method != scene::automatic &&
      method != mechanics::DormandPrince8::name)
    return scene::Refusal{"Time/Method", fmt::format("expected auto or {}, by which manifolds and sections are "
                                                     "computed, got {}",
                                                     mechanics::DormandPrince8::name, method)};
  const systems::AnyModel model = system.model(scene);
  if (scene.time.end < 0 && !std::holds_alternative<mechanics::AnyField>(model.form()))
    return scene::Refusal{"Time/End", fmt::format("expected a number > 0, got {}; backwards in time go systems in "
                                                  "coordinates, this one with Form = lagrange",
                                                  scene::print_number(scene.time.end))};
  return std::visit([&](const auto& form) { return refuses_method(scene, form); }, model.form());
}

/// The context of the same run with another scene.
RunContext with_scene(const RunContext& context, const scene::Scene& scene) {
  return derived(context, scene, context.needs);
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
  if (context.scene.analysis == scene::Analysis::manifolds) return run_manifolds(system, model, scales, context);
  scene::Scene forwards = of_program.scene;
  if (forwards.time.end < 0) {
    model.reverse();
    forwards.time.end *= -1;
  }
  if (context.scene.analysis == scene::Analysis::section)
    return run_section(system, model, scales, with_scene(context, forwards));
  return std::visit(
      [&](const auto& form) {
        if (const auto status = mechanics::check_declared_dependence(form, model.start()); !status)
          throw std::logic_error(status.reason());
        if (context.scene.analysis == scene::Analysis::equilibrium)
          return run_equilibria(model.landscape(), mechanics::dissipative(form), model.coordinates(), scales, context);
        SystemModel motion(system.description, form, model, scales, context.scene);
        const RunContext of_motion = with_scene(context, forwards);
        return ModelRun(motion, of_motion).run();
      },
      model.form());
}

ModelOutcome run_system(const RunContext& context) {
  for (const systems::AnySystemScene& system : systems::system_table())
    if (system.description.name == context.scene.system) return run_system(system, context);
  throw std::logic_error("no system is called " + context.scene.system);
}

}  // namespace pseudorigid::app
