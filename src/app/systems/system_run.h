#pragma once
/// A system of the table in the program.

#include "app/run/run_context.h"
#include "systems/any_system_scene.h"

namespace pseudorigid::app {

/// The system as parameter files and `pseudorigid parameters` show it. It refuses scenes that the program cannot run.
scene::SystemDescription describe_system(const systems::AnySystemScene& system);

/// The run of a scene of this system.
ModelOutcome run_system(const systems::AnySystemScene& system, const RunContext& context);

}  // namespace pseudorigid::app
