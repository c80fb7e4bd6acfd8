#pragma once
/// Runs `Analysis = equilibrium` for the finite-element model. The scene selects a family of figures that rotate
/// steadily about axis 3 (continuum/statics/ball_figures.h). With `Equilibrium/Family = static`, it selects the figure
/// at rest under the loads. The results are in equilibria-continuum.csv.
///
/// The figures are computed on the discretisation of the scene and on its companion (scene/discretization.h). The
/// differences of the results are the estimated errors of the discretisation. The figure at rest is found by
/// continuation from the undeformed ball, while the loads rise from 0 to their values.

#include "app/run/run_context.h"

namespace pseudorigid::app {

/// Computes the figures and writes the file. The outcome is `failed` if no figure is found or a row cannot be computed,
/// and `interrupted` after an interrupt. If the loads of a ball at rest cannot reach their full values, the file has
/// the last figure, and the outcome is `failed`.
ModelOutcome run_continuum_equilibria(const RunContext& context);

}  // namespace pseudorigid::app
