#pragma once
/// Runs `Analysis = equilibrium` for the polynomial model. It computes a family of figures that rotate steadily about
/// axis 3, and their stability (polynomial/rotation_family.h). The file equilibria-polynomial.csv has the rows of each
/// degree that the scene lists.

#include <optional>

#include "app/run/run_context.h"
#include "scene/catalogue.h"

namespace pseudorigid::app {

/// The reason why polynomial bodies do not have this family; empty if they have it.
std::optional<scene::Refusal> refuses_polynomial_equilibria(const scene::Scene& scene);

ModelOutcome run_polynomial_equilibria(const RunContext& context);

}  // namespace pseudorigid::app
