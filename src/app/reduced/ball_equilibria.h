#pragma once
/// Relative equilibria of the pseudo-rigid body of a scene (reduced/equilibrium_families.h). `Analysis = equilibrium`
/// writes a family into equilibria.csv. The entry Initial state/Equilibrium starts a motion in a member of a family.

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

/// Finds the member of this family with this parameter, in internal units.
mechanics::Status figure_of_family(const scene::Scene& scene, scene::Family family, double parameter,
                                   reduced::SteadyMotion& figure);

/// The name of the parameter in messages: "e", "a3/r", "spin" or "a2/a1".
std::string parameter_name(scene::Family family);

/// Replaces the entry Initial state/Equilibrium by explicit initial values
///
///   Q₀ = D A,   Q̇₀ = D (ω̂A − AΛ̂) + V
///
/// with A, ω, Λ of the equilibrium, Deformation D and Velocity V of the scene, and ω̂x = ω × x. Throws UserError if
/// there is no such equilibrium.
scene::Scene with_equilibrium(scene::Scene scene, const scene::Origins& origins);

}  // namespace pseudorigid::app
