#pragma once
/// Requirements of equilibria, modes, Love numbers and the energy of vibration on a scene of the ball.

#include <optional>

#include "scene/catalogue.h"

namespace pseudorigid::scene {

/// Returns the violated requirement, or nothing. A motion has only one requirement: if its initial state is a member of
/// a family of relative equilibria, the ball must have such equilibria.
std::optional<Refusal> refuses_analysis_of_ball(const Scene& scene);

/// The violated requirement of the quantities `vibration`, or nothing: the sphere has modes in closed form.
std::optional<Refusal> refuses_vibration(const Scene& scene);

}  // namespace pseudorigid::scene
