#pragma once
/// Runs `Analysis = equilibrium` for the polynomial model. For each degree that the scene lists, the run computes a
/// family of figures that rotate steadily about axis 3. The run also computes the stability of each figure
/// (polynomial/body_figure_finder.h). The results are in equilibria-polynomial.csv.

#include <optional>

#include "app/run/run_context.h"
#include "scene/catalogue.h"

namespace pseudorigid::app {

/// The refusal if the polynomial model cannot compute the family of the scene's equilibria, or of the figure from which
/// its motion starts. For equilibria, the scene must also list the degrees. Empty if the scene is accepted, or if it
/// does not need figures of the model.
std::optional<scene::Refusal> refuses_polynomial_equilibria(const scene::Scene& scene);

/// Computes the families of all degrees and writes the file. If the family has no figure for a value of the parameter,
/// logs a warning. The outcome is `failed` if no figure is found or a row cannot be computed, and `interrupted` after
/// an interrupt. In the last two cases, the file has the rows that were computed before.
ModelOutcome run_polynomial_equilibria(const RunContext& context);

}  // namespace pseudorigid::app
