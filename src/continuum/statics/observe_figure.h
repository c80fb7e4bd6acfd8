#pragma once
/// Observables of a figure of equilibrium of the finite-element ball, in the inertial frame. If the figure rotates with
/// the spin Ω, the velocity is Ω ê₃×x.

#include "continuum/statics/ball_figures.h"
#include "observables/body_observables.h"

namespace pseudorigid::continuum {

/// Sets the observables of the whole ball in internal units: positions, energies, the multiplier, the axes, the
/// non-affine quantities, and component 3 of angular momentum and circulation. Sets `surface` to the distances from the
/// centre at which the surface cuts the three axes. Fails if the deformation is not admissible.
mechanics::Status observe_figure(const BallFigures& figures, const mechanics::EquilibriumFigure& figure,
                                 mechanics::ContinuumObservables& observables, Eigen::Vector3d& surface);

}  // namespace pseudorigid::continuum
