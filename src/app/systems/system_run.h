#pragma once
/// Description and run of a system of the table (systems/table.h).

#include "app/run/run_context.h"
#include "systems/any_system_scene.h"

namespace pseudorigid::app {

/// The description of the system for parameter files and `pseudorigid parameters`. Its member `refuses` refuses the
/// scenes that the program cannot run.
scene::SystemDescription describe_system(const systems::AnySystemScene& system);

/// Runs a scene of this system.
ModelOutcome run_system(const systems::AnySystemScene& system, const RunContext& context);

}  // namespace pseudorigid::app
