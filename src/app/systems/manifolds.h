#pragma once
/// Runs `Analysis = manifolds` for a system. The run computes motions on the unstable and the stable manifolds of the
/// critical points of the system (Oliva, Geometric Mechanics, 5.8). The motions show which critical points are
/// connected. Critical points without an unstable manifold are skipped. In addition to equilibria.csv (equilibria.h)
/// the run writes
///
///   manifolds.csv     the motions: curve (number of the motion), point (number of the critical point on whose manifold
///                     the motion lies), stable (1 on a stable, 0 on an unstable manifold), time, and the columns of
///                     the system;
///   connections.csv   for each motion, the number of the critical point at which it ends, or 0, with the distance and
///                     the time.
///
/// On an unstable manifold of one dimension, two motions start in opposite directions. Unstable manifolds of more
/// dimensions have Manifolds/Starts motions. On a stable manifold, two motions start along each vector of a basis of
/// its tangent space. Motions on a stable manifold are computed backwards in time. A motion ends when its distance from
/// a critical point is below 1e-6, and at the latest at the time |Time/End|. The distance is measured in (q, q̇), in
/// the scales of the system (systems/system_scene.h). A motion that passes a critical point at a smaller distance is
/// therefore also reported as a connection. Let V₁ be the least and V₂ the largest potential energy of the critical
/// points. A motion on a stable manifold also ends, without a connection, if a step fails, or if V₂ > V₁ and its energy
/// exceeds V₂ + (V₂ − V₁). A motion on an unstable manifold that cannot be computed to its end has no row in
/// connections.csv, and the run then fails.

#include <vector>

#include "app/run/run_context.h"
#include "systems/any_system_scene.h"

namespace pseudorigid::app {

/// The columns of connections.csv with their units and texts.
std::vector<scene::Column> connections_columns();

/// Finds the critical points, computes the motions and writes the files. `scales` are the units of the system in the
/// user's units. The outcome is `failed` if the search fails or a motion cannot be computed, and `interrupted` after an
/// interrupt.
ModelOutcome run_manifolds(const systems::AnySystemScene& system, const systems::AnyModel& model,
                           const systems::Scales& scales, const RunContext& context);

}  // namespace pseudorigid::app
