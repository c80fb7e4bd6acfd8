#pragma once
/// Checks of a scene that involve several entries.

#include "scene/read_scene.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

/// Returns the scene if it is valid, otherwise throws a UserError. The text of the error is the origin and the name of
/// the entry, and the reason in one sentence. In the returned scene, Gravity/Gamma has set the constant of gravity, and
/// the initial state of an incompressible body is projected (scene/initial_state.h). The list of models is empty if the
/// system is not the ball.
Scene validate(Scene scene, const Origins& origins = {});

/// Whether validate accepts the scene. Recommendations are not made, and Gravity/Gamma replaces any given constant of
/// gravity.
bool is_accepted(Scene scene, const Origins& origins);

}  // namespace pseudorigid::scene
