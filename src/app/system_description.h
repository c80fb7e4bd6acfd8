#pragma once
/// A system of the table as parameter files and `pseudorigid parameters` know it (scene/catalogue.h).

#include <fmt/format.h>

#include "mechanics/field_of.h"
#include "mechanics/methods.h"
#include "scene/scales.h"
#include "systems/sizes.h"
#include "systems/system_scene.h"

namespace pseudorigid::app {

/// Whether the method that a scene asks for can run this system, and if not why.
template <class System>
std::optional<scene::Refusal> refuses_method(const scene::Scene& scene, const System& system) {
  const auto id = mechanics::find_method(scene.time.method);
  std::optional<scene::Refusal> refusal;
  if (!id) return refusal;
  mechanics::with_method(*id, [&]<class Method>(Method) {
    if constexpr (!mechanics::method_fits<Method, System>())
      refusal = {"Time/Method",
                 fmt::format("{} cannot integrate this form of the system; explicit-8 can", Method::name)};
    else if (mechanics::Status status = Method::accepts(mechanics::form_for<Method>(system)); !status)
      refusal = {"Time/Method", status.reason()};
  });
  return refusal;
}

template <class SystemScene>
std::optional<scene::Refusal> refuses_scene(const scene::Scene& scene) {
  const auto system = systems::system_scene<SystemScene>(scene);
  if (auto refusal = system.refuses()) return refusal;
  if (auto refusal = systems::refuses_sizes(system)) return refusal;
  if (scene.analysis == scene::Analysis::motion)
    if (auto refusal = scene::refuses_duration(scene.time.end, system.scales().time)) return refusal;
  return systems::in_scales(system, system.scales()).with_model([&](const auto& model) {
    return refuses_method(scene, model.system);
  });
}

template <class SystemScene>
scene::SystemDescription describe_system() {
  scene::SystemDescription description{
      .name = SystemScene::name,
      .file = SystemScene::file,
      .section = SystemScene::section,
      .documentation = SystemScene::documentation,
      .entries = {},
      .columns = SystemScene{}.columns(),
      .columns_of = [](const scene::Scene& scene) { return systems::system_scene<SystemScene>(scene).columns(); },
      .has_equilibria = SystemScene::has_equilibria,
      .refuses = refuses_scene<SystemScene>};
  const SystemScene defaults;
  SystemScene::visit(defaults, [&]<class Value>(const Value& member, const auto& kind, const scene::About& about) {
    description.entries.push_back({about, scene::AnyKind::of<Value>(kind), kind.print(member)});
  });
  return description;
}

}  // namespace pseudorigid::app
