#pragma once
/// Runs `Analysis = modes` for the finite-element model. It writes the frequencies about rest into modes.csv and the
/// modes as pictures.

#include "app/run/run_context.h"

namespace pseudorigid::app {

ModelOutcome run_modes(const RunContext& context);

}  // namespace pseudorigid::app
