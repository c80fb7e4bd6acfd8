#pragma once
/// The run of one system of the table. Each system is compiled in a file of its own (run_system.cpp.in): all models
/// times all methods in one would take minutes.

#include <cstddef>
#include <stdexcept>
#include <utility>

#include "app/equilibria.h"
#include "app/model_run.h"
#include "app/run_models.h"
#include "app/system_model.h"
#include "mechanics/declared_dependence.h"
#include "mechanics/second_order_field.h"
#include "systems/table.h"

namespace pseudorigid::app {

template <class SystemScene>
ModelOutcome run_system_scene(const RunContext& of_program) {
  const auto in_user_units = systems::system_scene<SystemScene>(of_program.scene);
  const systems::Scales scales = in_user_units.scales();
  RunContext context = of_program;
  context.units = {scales.length, scales.mass, scales.time};
  return systems::in_scales(in_user_units, scales).with_model([&]<class Model>(Model model) {
    using System = typename Model::System;
    static_assert(mechanics::ConstrainedSystem<System> || mechanics::SecondOrderField<System>,
                  "no method can run this system: a member of ConstrainedSystem (mechanics/constrained_system.h) or of "
                  "SecondOrderField (mechanics/second_order_field.h) is missing or misspelt");
    if (const auto status = mechanics::check_declared_dependence(model.system, model.initial); !status)
      throw std::logic_error(status.reason());
    if constexpr (SystemScene::has_equilibria)
      if (context.scene.analysis == scene::Analysis::equilibrium)
        return run_equilibria(mechanics::AnyLandscape(model.landscape()), mechanics::dissipative(model.system),
                              model.coordinates(), scales, context);
    SystemModel<SystemScene, Model> system(in_user_units, std::move(model), scales);
    return ModelRun(system, context).run();
  });
}

/// That of the place in the table.
template <std::size_t place>
ModelOutcome run_system_at(const RunContext& context);

}  // namespace pseudorigid::app
