#pragma once
/// Relative equilibria of the reduced body (reduced/equilibrium_families.h) for scenes: Analysis = equilibrium writes a
/// family as equilibria.csv, and Initial state/Equilibrium begins a motion with a member of one.

#include <string>
#include <vector>

#include "app/run/run_context.h"
#include "mechanics/core/status.h"
#include "reduced/steady_motion.h"
#include "scene/catalogue.h"
#include "scene/read_scene.h"

namespace pseudorigid::app {

/// The columns of equilibria.csv for the ball.
std::vector<scene::Column> ball_equilibria_columns();

ModelOutcome run_ball_equilibria(const RunContext& context);

/// The figure of that family of the scene with this parameter, in internal units.
mechanics::Status figure_of_family(const scene::Scene& scene, scene::Family family, double parameter,
                                   reduced::SteadyMotion& figure);

/// "e", "a3/r", "spin" or "a2/a1"
std::string parameter_name(scene::Family family);

/// The scene with Initial state/Equilibrium turned into Q₀ and Q̇₀: with A, ω, Λ of the equilibrium, Deformation D and
/// Velocity V of the scene,  Q₀ = D A,  Q̇₀ = D (ω̂A − AΛ̂) + V. Throws UserError if there is no such equilibrium.
scene::Scene with_equilibrium(scene::Scene scene, const scene::Origins& origins);

}  // namespace pseudorigid::app
