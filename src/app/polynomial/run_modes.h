#pragma once
/// Analysis = modes of the polynomial model: the frequencies of the ball at rest, in modes.csv; beside the continuum,
/// which has that file, in modes-polynomial.csv.

#include "app/run/run_context.h"

namespace pseudorigid::app {

ModelOutcome run_polynomial_modes(const RunContext& context);

}  // namespace pseudorigid::app
