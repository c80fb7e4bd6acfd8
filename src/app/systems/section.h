#pragma once
/// Runs `Analysis = section` for a system. The run computes the points at which a motion crosses a surface of section
/// (Poincaré). On this surface, one column of the system's file has a given value. The points are the rows of
/// section.csv, with the columns of the motion.
///
/// Within each step the column is evaluated at eight times by interpolation. If the column crosses the value between
/// two of these times in a direction that the scene requests, the time of the crossing is found up to round-off. For
/// this purpose the motion is integrated again from the start of the step. A jump of a column, for example of an angle
/// after a full rotation, is not a crossing.

#include "app/run/run_context.h"
#include "systems/any_system_scene.h"

namespace pseudorigid::app {

/// Computes the motion from the start to Time/End and writes its crossings. `scales` are the units of the system in the
/// user's units. The outcome is `failed` if a step fails or a column cannot be computed, and `interrupted` after an
/// interrupt. In both cases, the file has the earlier crossings.
ModelOutcome run_section(const systems::AnySystemScene& system, systems::AnyModel& model, const systems::Scales& scales,
                         const RunContext& context);

}  // namespace pseudorigid::app
