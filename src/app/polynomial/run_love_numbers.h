#pragma once
/// Runs `Analysis = love numbers` for polynomial bodies. The last degree of the list writes love-polynomial.csv, and
/// each other degree N writes love-polynomial-<N>.csv.

#include "app/run/run_context.h"

namespace pseudorigid::app {

/// Computes the Love numbers of all degrees of the scene. The outcome is `failed` if a solution fails, and
/// `interrupted` after an interrupt. The later files are then not written.
ModelOutcome run_polynomial_love_numbers(const RunContext& context);

}  // namespace pseudorigid::app
