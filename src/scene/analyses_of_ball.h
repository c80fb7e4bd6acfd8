#pragma once
/// Requirements of equilibria, modes and Love numbers on a scene of the ball.

#include <optional>

#include "scene/catalogue.h"

namespace pseudorigid::scene {

/// A motion is refused only if its initial state is an equilibrium that the scene does not have.
std::optional<Refusal> refuses_analysis_of_ball(const Scene& scene);

}  // namespace pseudorigid::scene
