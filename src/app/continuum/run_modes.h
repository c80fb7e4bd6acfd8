#pragma once
/// Analysis = modes: frequencies and shapes of the ball at rest, modes.csv and pictures.

#include "app/run/run_context.h"

namespace pseudorigid::app {

ModelOutcome run_modes(const RunContext& context);

}  // namespace pseudorigid::app
