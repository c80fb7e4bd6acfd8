#pragma once
/// Runs `Analysis = love numbers` for polynomial bodies. The last degree of the list writes love-polynomial.csv, and
/// each other degree N writes love-polynomial-<N>.csv.

#include "app/run/run_context.h"

namespace pseudorigid::app {

/// Computes the Love numbers for all degrees of the scene. The outcome is `failed` if the Love numbers of a degree
/// cannot be computed, and `interrupted` after an interrupt. The files of this degree and of the later degrees are then
/// not written.
ModelOutcome run_polynomial_love_numbers(const RunContext& context);

}  // namespace pseudorigid::app
