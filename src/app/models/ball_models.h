#pragma once
/// The models of the ball. A model is one source file with its description, one line in the table below, and the
/// function that runs it (run_models.h, Executable).

#include <array>
#include <optional>

#include "scene/catalogue.h"

namespace pseudorigid::app {

scene::ModelDescription reduced_description();
scene::ModelDescription polynomial_description();
scene::ModelDescription continuum_description();

/// The poorest in motions first, as the catalogue has them.
inline constexpr std::array ball_models{reduced_description, polynomial_description, continuum_description};

/// Why the method of the scene cannot integrate it, or the law cannot have its start, if so. It is asked of the
/// pseudo-rigid body, of which every model of the ball is a finer one.
std::optional<scene::Refusal> refuses_motion(const scene::Scene& scene);

}  // namespace pseudorigid::app
