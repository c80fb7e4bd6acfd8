#pragma once
/// Analysis = section: the points where the motion of a system crosses a surface of section (Poincaré), a column of its
/// file = a value, as section.csv with the columns of the motion. Between steps crossings are looked for at eight times
/// of the dense output; each is then located to round-off on a motion that is integrated anew from the start of its
/// step. If a column jumps, as an angle does at a full turn, nothing is crossed.

#include "app/run/run_context.h"
#include "systems/any_system_scene.h"

namespace pseudorigid::app {

ModelOutcome run_section(const systems::AnySystemScene& system, systems::AnyModel& model, const systems::Scales& scales,
                         const RunContext& context);

}  // namespace pseudorigid::app
