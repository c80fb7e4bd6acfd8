#pragma once
/// A system of the table in the program.

#include "app/run/run_context.h"
#include "systems/any_system_scene.h"

namespace pseudorigid::app {

/// As parameter files and `pseudorigid parameters` know it; it refuses what the program cannot run.
scene::SystemDescription describe_system(const systems::AnySystemScene& system);

/// The run of a scene of this system.
ModelOutcome run_system(const systems::AnySystemScene& system, const RunContext& context);

}  // namespace pseudorigid::app
