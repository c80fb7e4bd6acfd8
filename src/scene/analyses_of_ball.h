#pragma once
/// Requirements of equilibria, modes, Love numbers and the energy of vibration on a scene of the ball.

#include <optional>

#include "scene/catalogue.h"

namespace pseudorigid::scene {

/// Returns the violated requirement of the analysis of the scene, or nothing. For every analysis, if the initial state
/// is a member of a family of relative equilibria, the ball must have such equilibria. This function does not check
/// other requirements of a motion.
std::optional<Refusal> refuses_analysis_of_ball(const Scene& scene);

/// Returns the violated requirement of the columns `vibration` of a motion, or nothing. These columns use closed
/// formulas for the modes of an incompressible elastic sphere. The body must therefore be an incompressible elastic
/// ball without a mesh from a file, self-gravity or viscoelastic branches. There is no requirement if the scene does
/// not request these columns, or if the analysis is not a motion.
std::optional<Refusal> refuses_vibration(const Scene& scene);

}  // namespace pseudorigid::scene
