#pragma once
/// Checks of a scene that involve several entries.

#include "scene/read_scene.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

/// Returns the valid scene. The initial state of an incompressible body is projected (scene/initial_state.h), and a
/// scene of another system has no models of the ball. Throws UserError with one sentence, which begins with the origin
/// of the entry and describes the expected value.
Scene validate(Scene scene, const Origins& origins = {});

/// Whether validate accepts the scene. Recommendations are not made.
bool is_accepted(Scene scene, const Origins& origins);

}  // namespace pseudorigid::scene
