#pragma once
/// What equilibria and modes ask of a scene of the ball.

#include <optional>

#include "scene/catalogue.h"

namespace pseudorigid::scene {

/// Of a motion: what an equilibrium asks that is its initial state.
std::optional<Refusal> refuses_analysis_of_ball(const Scene& scene);

}  // namespace pseudorigid::scene
