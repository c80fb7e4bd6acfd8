#pragma once
/// Requirements of equilibria, modes, Love numbers and the energy of vibration on a scene of the ball.

#include <optional>

#include "scene/catalogue.h"

namespace pseudorigid::scene {

/// Returns the violated requirement, or nothing. All analyses share one requirement: if the initial state is a member
/// of a family of relative equilibria, the ball must have such equilibria. A motion has no other requirement here.
std::optional<Refusal> refuses_analysis_of_ball(const Scene& scene);

/// The violated requirement of the columns `vibration` of a motion, or nothing. These columns use the modes in closed
/// form of an incompressible elastic sphere. The body must therefore be an incompressible elastic ball without a mesh
/// from a file, self-gravity or viscoelastic branches. There is no requirement if the scene does not request these
/// columns, or if the analysis is not a motion.
std::optional<Refusal> refuses_vibration(const Scene& scene);

}  // namespace pseudorigid::scene
