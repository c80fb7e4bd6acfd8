#pragma once
/// What equilibria and modes ask of a scene of the ball.

#include <optional>

#include "scene/catalogue.h"

namespace pseudorigid::scene {

/// Nothing where the scene's analysis is a motion.
std::optional<Refusal> refuses_analysis_of_ball(const Scene& scene);

}  // namespace pseudorigid::scene
