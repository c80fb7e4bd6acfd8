#pragma once
/// Checks of a scene that need several entries.

#include "scene/read_scene.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

/// The scene to run: `scene` with the initial state projected (scene/initial_state.h). Throws UserError with one
/// sentence, which begins with the origin of the entry and describes the expected value.
Scene validate(Scene scene, const Origins& origins = {});

/// Whether validate takes it.
bool is_accepted(Scene scene, const Origins& origins);

}  // namespace pseudorigid::scene
