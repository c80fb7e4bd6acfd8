#pragma once
/// Check whether the method of a scene can integrate a system.

#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "mechanics/core/conservative_system.h"
#include "mechanics/core/field_of.h"
#include "mechanics/methods/methods.h"
#include "scene/catalogue.h"
#include "scene/scene.h"

namespace pseudorigid::app {

/// A refusal of the entry Time/Method with the message `sentence`. Every method is listed as a remedy. The program then
/// recommends only those methods with which the scene is accepted.
inline scene::Refusal refusal_of_method(std::string sentence) {
  scene::Refusal refusal{"Time/Method", std::move(sentence)};
  mechanics::for_each_method([&]<class Method>(Method) { refusal.remedies.push_back({{refusal.path, Method::name}}); });
  return refusal;
}

/// True if the method of this name can integrate systems of the type `System`. Also true if there is no method of this
/// name, as for "auto".
template <class System>
bool method_can_run(std::string_view name) {
  const auto id = mechanics::find_method(name);
  return !id ||
         mechanics::with_method(*id, []<class Method>(Method) { return mechanics::method_fits<Method, System>(); });
}

/// The refusal if the scene's method cannot integrate this system; empty if it can, or if the method is auto.
template <class System>
std::optional<scene::Refusal> refuses_method(const scene::Scene& scene, const System& system) {
  const auto id = mechanics::find_method(scene.time.method);
  if (!id) return {};
  return mechanics::with_method(*id, [&]<class Method>(Method) -> std::optional<scene::Refusal> {
    if (mechanics::fits<Method>(system)) {
      if constexpr (mechanics::method_fits<Method, System>())
        if (mechanics::Status status = Method::accepts(mechanics::form_for<Method>(system)); !status) {
          // The text of `accepts` ends with a recommendation of methods. This part is omitted, because other models of
          // the scene may not have these methods.
          const std::string& reason = status.reason();
          return refusal_of_method(reason.substr(0, reason.find("; use ")));
        }
      return {};
    }
    constexpr bool lacks_energy = mechanics::ConstrainedSystem<System> && !mechanics::ConservativeSystem<System>;
    return refusal_of_method(fmt::format("{} cannot integrate this form of the system{}", Method::name,
                                         lacks_energy
                                             ? ": it takes no dissipation, contact, companions, branches or loads "
                                               "that change in time"
                                             : ""));
  });
}

}  // namespace pseudorigid::app
