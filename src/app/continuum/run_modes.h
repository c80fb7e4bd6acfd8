#pragma once
/// Runs `Analysis = modes` for the finite-element model. The file modes.csv has the frequencies about rest. If the
/// scene requests pictures, the modes are also written as pictures.

#include "app/run/run_context.h"

namespace pseudorigid::app {

ModelOutcome run_modes(const RunContext& context);

}  // namespace pseudorigid::app
