#pragma once
/// Runs `Analysis = modes` for the polynomial model and writes the frequencies about rest into modes.csv. The file is
/// modes-polynomial.csv if the scene also has the finite-element model.

#include "app/run/run_context.h"

namespace pseudorigid::app {

ModelOutcome run_polynomial_modes(const RunContext& context);

}  // namespace pseudorigid::app
