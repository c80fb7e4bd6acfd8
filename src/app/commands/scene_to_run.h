#pragma once
/// Conversion of the scene in the parameter file to a validated scene with explicit initial values, which the program
/// runs.

#include "app/reduced/ball_equilibria.h"
#include "scene/validate.h"

namespace pseudorigid::app {

/// Validates the scene and replaces the entry Initial state/Equilibrium by explicit initial values of the deformation Q
/// and its rate (with_equilibrium). Throws UserError if the scene is not valid, or if the equilibrium does not exist.
inline scene::Scene scene_to_run(const scene::Scene& read, const scene::Origins& origins) {
  scene::Scene scene = scene::validate(read, origins);
  if (scene.initial_state.equilibrium == scene::Family::none) return scene;
  return scene::validate(with_equilibrium(std::move(scene), origins), origins);
}

}  // namespace pseudorigid::app
