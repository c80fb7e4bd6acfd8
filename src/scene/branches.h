#pragma once
/// Checks of viscoelastic branches (loads/viscoelasticity.h). There are at most four. Each has a modulus and a time.

#include <optional>

#include "scene/catalogue.h"

namespace pseudorigid::scene {

/// Returns the violated requirement, or nothing. A scene without branches does not have requirements.
std::optional<Refusal> refuses_branches(const Scene& scene);

}  // namespace pseudorigid::scene
