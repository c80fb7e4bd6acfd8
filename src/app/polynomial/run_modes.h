#pragma once
/// Runs `Analysis = modes` for the polynomial model and writes the frequencies about rest into modes.csv. If the scene
/// has another model too, the file is modes-polynomial.csv.

#include "app/run/run_context.h"

namespace pseudorigid::app {

ModelOutcome run_polynomial_modes(const RunContext& context);

}  // namespace pseudorigid::app
