#pragma once
/// Runs `Analysis = equilibrium` for the polynomial model. For each degree that the scene lists, the run computes a
/// family of figures that rotate steadily about axis 3. The run also computes the stability of each figure
/// (polynomial/rotation_family.h). The results are in equilibria-polynomial.csv.

#include <optional>

#include "app/run/run_context.h"
#include "scene/catalogue.h"

namespace pseudorigid::app {

/// The reason why the polynomial model refuses the equilibria of the scene, or the figure from which its motion starts.
/// Empty if the polynomial model can compute them, or if the scene does not need them.
std::optional<scene::Refusal> refuses_polynomial_equilibria(const scene::Scene& scene);

/// Computes the families of all degrees. If the family has no figure for a value of the parameter, logs a warning. The
/// outcome is `failed` if no figure is found or a row cannot be computed, and `interrupted` after an interrupt.
ModelOutcome run_polynomial_equilibria(const RunContext& context);

}  // namespace pseudorigid::app
