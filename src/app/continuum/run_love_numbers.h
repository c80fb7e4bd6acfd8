#pragma once
/// Analysis = love numbers of the finite-element ball: love-continuum.csv.

#include "app/run/run_context.h"

namespace pseudorigid::app {

ModelOutcome run_continuum_love_numbers(const RunContext& context);

}  // namespace pseudorigid::app
