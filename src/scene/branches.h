#pragma once
/// Checks of viscoelastic branches (loads/viscoelasticity.h). A scene has at most four branches. Each branch needs a
/// modulus and a relaxation time.

#include <optional>

#include "scene/catalogue.h"

namespace pseudorigid::scene {

/// Returns the violated requirement, or nothing. A scene without branches must not set relaxation times or relaxed
/// branches.
std::optional<Refusal> refuses_branches(const Scene& scene);

}  // namespace pseudorigid::scene
