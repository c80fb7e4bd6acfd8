#pragma once
/// Whether the method that a scene asks for can run a system.

#include <fmt/format.h>

#include <optional>

#include "mechanics/core/field_of.h"
#include "mechanics/methods/methods.h"
#include "scene/catalogue.h"
#include "scene/scene.h"

namespace pseudorigid::app {

/// If not, why.
template <class System>
std::optional<scene::Refusal> refuses_method(const scene::Scene& scene, const System& system) {
  const auto id = mechanics::find_method(scene.time.method);
  if (!id) return {};
  return mechanics::with_method(*id, [&]<class Method>(Method) -> std::optional<scene::Refusal> {
    if (mechanics::fits<Method>(system)) {
      if constexpr (mechanics::method_fits<Method, System>())
        if (mechanics::Status status = Method::accepts(mechanics::form_for<Method>(system)); !status)
          return scene::Refusal{"Time/Method", status.reason()};
      return {};
    }
    return scene::Refusal{"Time/Method",
                          fmt::format("{} cannot integrate this form of the system; explicit-8 can", Method::name)};
  });
}

}  // namespace pseudorigid::app
