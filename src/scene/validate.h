#pragma once
/// Checks of a scene that involve several entries.

#include "scene/read_scene.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

/// Returns the scene if it is valid, otherwise throws a UserError. The text of the error is the origin and the name of
/// an entry, and the reason in one sentence. The reason includes recommendations (scene/advice.h), if any of them would
/// make the scene valid. In the returned scene, Gravity/Gamma has set the constant of gravity, and the initial state of
/// an incompressible body is projected (scene/initial_state.h). The list of models is empty if the system is not the
/// ball.
Scene validate(Scene scene, const Origins& origins = {});

/// Returns true if the checks of `validate` accept the scene, for trials of recommendations. The function does not
/// compute recommendations itself. It does not refuse Gravity/Gamma in a scene that has another constant of gravity,
/// because `validate` may have set this constant before the recommended change.
bool is_accepted(Scene scene, const Origins& origins);

}  // namespace pseudorigid::scene
