#pragma once
/// Runs `Analysis = love numbers` for the finite-element ball and writes love-continuum.csv.

#include "app/run/run_context.h"

namespace pseudorigid::app {

/// Computes the Love numbers on the discretisation of the scene and, for the error bounds, on its companion
/// discretisation (scene/discretization.h). The scene must set degree and refinements. The outcome is `failed` if a
/// solution fails, and `interrupted` after an interrupt. The file is then not written.
ModelOutcome run_continuum_love_numbers(const RunContext& context);

}  // namespace pseudorigid::app
