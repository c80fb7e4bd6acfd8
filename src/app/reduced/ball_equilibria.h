#pragma once
/// Relative equilibria of the reduced body (reduced/equilibrium_families.h) for scenes: Analysis = equilibrium writes a
/// family as equilibria.csv, and Initial state/Equilibrium begins a motion with a member of one.

#include <vector>

#include "app/run/run_context.h"
#include "scene/catalogue.h"
#include "scene/read_scene.h"

namespace pseudorigid::app {

/// The columns of equilibria.csv for the ball.
std::vector<scene::Column> ball_equilibria_columns();

ModelOutcome run_ball_equilibria(const RunContext& context);

/// The scene with Initial state/Equilibrium turned into Q₀ and Q̇₀: with A, ω, Λ of the equilibrium, Deformation D and
/// Velocity V of the scene,  Q₀ = D A,  Q̇₀ = D (ω̂A − AΛ̂) + V. Throws UserError if there is no such equilibrium.
scene::Scene with_equilibrium(scene::Scene scene, const scene::Origins& origins);

}  // namespace pseudorigid::app
