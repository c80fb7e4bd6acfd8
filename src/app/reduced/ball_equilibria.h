#pragma once
/// Relative equilibria of the pseudo-rigid body of a scene (reduced/equilibrium_families.h). `Analysis = equilibrium`
/// writes a family of relative equilibria into equilibria.csv. With the entry Initial state/Equilibrium, a motion
/// starts at a member of a family.

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

/// Computes the family of the scene and writes equilibria.csv. The outcome is `failed` if the family has no member for
/// the requested parameters; no file is then written. After an interrupt, the outcome is `interrupted`, and the file
/// has the members that were found before.
ModelOutcome run_ball_equilibria(const RunContext& context);

/// Sets `figure` to the member of the family with this parameter, in internal units. If the parameter is a spin,
/// `parameter` has the user's unit. Fails if there is no such member.
mechanics::Status figure_of_family(const scene::Scene& scene, scene::Family family, double parameter,
                                   reduced::SteadyMotion& figure);

/// The name of the family's parameter in messages: "e", "a3/r", "spin", "a2/a1" or "factor of the loads".
std::string parameter_name(scene::Family family);

/// Replaces the entry Initial state/Equilibrium by explicit initial values of the deformation Q and its rate,
///
///   Q₀ = D A,   Q̇₀ = D (ω̂A − AΛ̂) + V
///
/// with the constants A, ω and Λ of the equilibrium Q(t) = exp(tω̂) A exp(−tΛ̂) in the user's units, and ω̂x = ω × x. D
/// and V are the entries Deformation and Velocity of the scene. If a model of a motion is affine, the start also
/// has the small motion of the entry Initial state/Mode. Stores the family, its parameter, D and V in
/// initial_state.origin. Returns the new scene, or an unchanged scene if the entry is `none`. Throws UserError if there
/// is no such equilibrium or small motion.
scene::Scene with_equilibrium(scene::Scene scene, const scene::Origins& origins);

}  // namespace pseudorigid::app
