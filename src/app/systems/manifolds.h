#pragma once
/// Analysis = manifolds: motions on the unstable and the stable manifolds of a system's critical points (Oliva,
/// Geometric Mechanics, 5.8), and which points they join. In addition to equilibria.csv it writes
///
///   manifolds.csv     the motions: curve, point, stable, time, and the columns of the system;
///   connections.csv   a row each: its end.
///
/// Those on a stable manifold are followed backwards in time. A motion ends at a critical point where it comes to
/// within 1e-6 of it, in (q, q̇) and the scene's units: what two manifolds that are nearer than that have in common is
/// not told apart from a connection.

#include <vector>

#include "app/run/run_context.h"
#include "systems/any_system_scene.h"

namespace pseudorigid::app {

std::vector<scene::Column> connections_columns();

ModelOutcome run_manifolds(const systems::AnySystemScene& system, const systems::AnyModel& model,
                           const systems::Scales& scales, const RunContext& context);

}  // namespace pseudorigid::app
