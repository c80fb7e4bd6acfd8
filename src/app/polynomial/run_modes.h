#pragma once
/// Analysis = modes of the polynomial model: the frequencies of the ball at rest, in modes.csv. If the scene has the
/// finite-element model as well, they are in modes-polynomial.csv.

#include "app/run/run_context.h"

namespace pseudorigid::app {

ModelOutcome run_polynomial_modes(const RunContext& context);

}  // namespace pseudorigid::app
