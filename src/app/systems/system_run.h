#pragma once
/// Description and run of a system of the table (systems/table.h).

#include "app/run/run_context.h"
#include "systems/any_system_scene.h"

namespace pseudorigid::app {

/// The description of the system for parameter files and `pseudorigid parameters`. Its function `refuses` also checks
/// the duration, the method and the direction of time.
scene::SystemDescription describe_system(const systems::AnySystemScene& system);

/// Runs the analysis of a scene of this system. For motions and equilibria, throws std::logic_error if the force
/// depends on the time or the velocity although the system does not declare this dependence. For a system in
/// coordinates, only the dependence on the time is tested.
ModelOutcome run_system(const systems::AnySystemScene& system, const RunContext& context);

}  // namespace pseudorigid::app
