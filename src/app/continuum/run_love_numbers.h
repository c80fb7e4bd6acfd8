#pragma once
/// Runs `Analysis = love numbers` for the finite-element ball and writes love-continuum.csv.

#include "app/run/run_context.h"

namespace pseudorigid::app {

ModelOutcome run_continuum_love_numbers(const RunContext& context);

}  // namespace pseudorigid::app
