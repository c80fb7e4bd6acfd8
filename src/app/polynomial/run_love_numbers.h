#pragma once
/// Analysis = love numbers of polynomial bodies: love-polynomial.csv, and love-polynomial-<N>.csv of the lower degrees
/// of a list.

#include "app/run/run_context.h"

namespace pseudorigid::app {

ModelOutcome run_polynomial_love_numbers(const RunContext& context);

}  // namespace pseudorigid::app
