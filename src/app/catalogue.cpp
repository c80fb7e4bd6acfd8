#include "app/catalogue.h"

#include <fmt/format.h>

#include "mechanics/field_of.h"
#include "mechanics/methods.h"
#include "systems/table.h"

namespace pseudorigid::app {
namespace {

using scene::Refusal;

/// Whether the method asked for can run this model, and if not why.
template <class Model>
std::optional<Refusal> refuses_method(const scene::Scene& scene, const Model& model) {
  const auto id = mechanics::find_method(scene.time.method);
  std::optional<Refusal> refusal;
  if (!id) return refusal;
  mechanics::with_method(*id, [&]<class Method>(Method) {
    if constexpr (!mechanics::method_fits<Method, typename Model::System>())
      refusal = {"Time/Method",
                 fmt::format("{} cannot integrate this form of the system; explicit-8 can", Method::name)};
    else if (mechanics::Status status = Method::accepts(mechanics::form_for<Method>(model.system)); !status)
      refusal = {"Time/Method", status.reason()};
  });
  return refusal;
}

template <class SystemScene>
std::optional<Refusal> refuses(const scene::Scene& scene) {
  const auto system = systems::system_scene<SystemScene>(scene);
  if (auto refusal = system.refuses()) return refusal;
  return systems::in_scales(system, system.scales()).with_model([&](const auto& model) {
    return refuses_method(scene, model);
  });
}

template <class SystemScene>
scene::SystemDescription describe() {
  scene::SystemDescription description{.name = SystemScene::name,
                                       .file = SystemScene::file,
                                       .section = SystemScene::section,
                                       .documentation = SystemScene::documentation,
                                       .entries = {},
                                       .columns = SystemScene{}.columns(),
                                       .has_equilibria = SystemScene::has_equilibria,
                                       .refuses = refuses<SystemScene>};
  const SystemScene defaults;
  SystemScene::visit(defaults, [&]<class Value>(const Value& member, const auto& kind, const scene::About& about) {
    description.entries.push_back({about, scene::AnyKind::of<Value>(kind), kind.print(member)});
  });
  return description;
}

scene::Catalogue make_catalogue() {
  scene::Catalogue catalogue;
  mechanics::for_each_method([&]<class Method>(Method) {
    catalogue.methods.push_back({Method::name, Method::documentation, mechanics::takes_any_vector<Method>});
  });
  systems::for_each_system(
      [&]<class SystemScene>(const SystemScene&) { catalogue.systems.push_back(describe<SystemScene>()); });
  return catalogue;
}

}  // namespace

const scene::Catalogue& program_catalogue() {
  static const scene::Catalogue catalogue = make_catalogue();
  return catalogue;
}

}  // namespace pseudorigid::app
