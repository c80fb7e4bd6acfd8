#pragma once
/// Runs `Analysis = equilibrium` for the finite-element model. The scene selects a family of figures that rotate
/// steadily about axis 3 (continuum/statics/ball_figures.h). With `Equilibrium/Family = static`, the family is the
/// figure at rest under the loads. The results, including the stability of each figure, are in
/// equilibria-continuum.csv.
///
/// The figures are computed on the discretisation of the scene and on its companion (scene/discretization.h). The
/// differences of the results are the estimated errors of the discretisation. The error of the rates also contains the
/// difference from a smaller basis of small motions. The figure at rest is found by continuation from the undeformed
/// ball, while the loads rise from 0 to their values.

#include "app/run/run_context.h"

namespace pseudorigid::app {

/// Computes the figures and writes the file. The scene must set degree and refinements. The outcome is `failed` if no
/// figure is found or a row cannot be computed, and `interrupted` after an interrupt. If the loads of a ball at rest
/// cannot reach their full values, the file has the figure with the largest loads, and the outcome is `failed`.
ModelOutcome run_continuum_equilibria(const RunContext& context);

}  // namespace pseudorigid::app
