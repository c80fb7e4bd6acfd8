#pragma once
/// Runs `Analysis = love numbers` for polynomial bodies. The last degree of the list writes love-polynomial.csv, and
/// each other degree N writes love-polynomial-<N>.csv.

#include "app/run/run_context.h"

namespace pseudorigid::app {

ModelOutcome run_polynomial_love_numbers(const RunContext& context);

}  // namespace pseudorigid::app
