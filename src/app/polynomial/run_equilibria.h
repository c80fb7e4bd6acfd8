#pragma once
/// Analysis = equilibrium of the polynomial model: a family of figures that turn steadily about axis 3, with their
/// stability (polynomial/rotation_family.h), as equilibria-polynomial.csv: the rows of each degree that the scene
/// lists.

#include <optional>

#include "app/run/run_context.h"
#include "scene/catalogue.h"

namespace pseudorigid::app {

/// The reason why a family is refused for polynomial bodies, if it is.
std::optional<scene::Refusal> refuses_polynomial_equilibria(const scene::Scene& scene);

ModelOutcome run_polynomial_equilibria(const RunContext& context);

}  // namespace pseudorigid::app
