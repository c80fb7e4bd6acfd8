#pragma once
/// The scene of any system (system_scene.h) as one type. The parts of the program outside systems/ use the scene of a
/// system only through this type.

#include <optional>
#include <utility>

#include "systems/any_model.h"
#include "systems/sizes.h"
#include "systems/system_scene.h"

namespace pseudorigid::systems {

struct AnySystemScene {
  /// The description of the system for parameter files. Its function `refuses` returns the error of a scene, or an
  /// empty result for a valid scene.
  scene::SystemDescription description;
  /// The function `scales` returns the units of a valid scene, expressed in the units of the user. The function `model`
  /// returns the model of a valid scene in these units.
  Scales (*scales)(const scene::Scene& scene);
  AnyModel (*model)(const scene::Scene& scene);
};

namespace detail {

/// The model of a system whose entries are in the scales of the scene.
template <class SystemScene>
AnyModel model_of(const SystemScene& in_own_scales) {
  return in_own_scales.with_model([]<class Model>(Model model) {
    static_assert(
        !SystemScene::has_equilibria ||
            requires {
              model.landscape();
              model.coordinates();
            },
        "a system with equilibria has a landscape() and names its coordinates()");
    return AnyModel(std::move(model));
  });
}

/// The error in a scene. The function checks the conditions of the system itself, and then the sizes of the numbers and
/// the initial state (refuses_sizes in sizes.h). The result is empty if the scene is valid.
template <class SystemScene>
std::optional<Refusal> refuses(const scene::Scene& scene) {
  const auto system = system_scene<SystemScene>(scene);
  if (auto refusal = system.refuses()) return refusal;
  return refuses_sizes(system, [](const SystemScene& in_own_scales) {
    const AnyModel::State start = model_of(in_own_scales).start();
    return start.q.allFinite() && start.v.allFinite();
  });
}

}  // namespace detail

/// Makes the description and the functions of the system from the members of SystemScene (system_scene.h).
template <class SystemScene>
AnySystemScene any_system_scene() {
  scene::SystemDescription description{
      .name = SystemScene::name,
      .file = SystemScene::file,
      .section = SystemScene::section,
      .documentation = SystemScene::documentation,
      .entries = {},
      .columns = SystemScene{}.columns(),
      .columns_of = [](const scene::Scene& scene) { return system_scene<SystemScene>(scene).columns(); },
      .has_equilibria = SystemScene::has_equilibria,
      .complete =
          [] {
            if constexpr (requires { SystemScene::complete; }) return SystemScene::complete;
            return false;
          }(),
      .refuses = detail::refuses<SystemScene>};
  const SystemScene defaults;
  SystemScene::visit(defaults, [&]<class Value>(const Value& member, const auto& kind, const scene::About& about) {
    description.entries.push_back({about, scene::AnyKind::of<Value>(kind), kind.print(member)});
  });
  return {.description = std::move(description),
          .scales = [](const scene::Scene& scene) { return system_scene<SystemScene>(scene).scales(); },
          .model =
              [](const scene::Scene& scene) {
                const auto system = system_scene<SystemScene>(scene);
                return detail::model_of(in_scales(system, system.scales()));
              }};
}

}  // namespace pseudorigid::systems
