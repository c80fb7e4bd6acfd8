#pragma once
/// Checks of a scene that involve several entries.

#include "scene/read_scene.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

/// Returns the scene to run, which is `scene` with a projected initial state (scene/initial_state.h). Throws UserError
/// with one sentence. The sentence begins with the origin of the entry and describes the expected value.
Scene validate(Scene scene, const Origins& origins = {});

/// Whether validate accepts the scene.
bool is_accepted(Scene scene, const Origins& origins);

}  // namespace pseudorigid::scene
