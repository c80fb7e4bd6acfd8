#pragma once
/// Requirements of equilibria, modes and Love numbers on a scene of the ball.

#include <optional>

#include "scene/catalogue.h"

namespace pseudorigid::scene {

/// Returns the violated requirement, or nothing. A motion has only one requirement: if its initial state is a member of
/// a family of relative equilibria, the ball must have such equilibria.
std::optional<Refusal> refuses_analysis_of_ball(const Scene& scene);

}  // namespace pseudorigid::scene
