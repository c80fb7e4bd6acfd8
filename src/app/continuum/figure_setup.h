#pragma once
/// The finite-element ball whose figures of equilibrium a scene requires.

#include "app/continuum/stored_energy.h"
#include "app/run/scene_to_model.h"
#include "continuum/statics/ball_figures.h"

namespace pseudorigid::app {

/// Number of eigenvectors of each parity in the basis of the small motions about a figure. The parity is that under the
/// reflections of the three axes.
inline constexpr int n_eigenvectors_of_figure = 10;

/// The setup of figures of the kind `figure`, on elements of this degree and this number of refinements of the mesh.
/// The figures depend on the loads if Equilibrium/Family is `static`, and on the rotation about axis 3 in all other
/// cases.
inline continuum::FigureSetup figure_setup(const scene::Scene& scene, int degree, int n_refinements,
                                           mechanics::Figure figure) {
  return {.degree = degree,
          .n_refinements = n_refinements,
          .stored = stored_energy(scene),
          .loads = internal_loads(scene),
          .incompressible = scene.body.incompressible,
          .drive = scene::finds_static_equilibria(scene) ? continuum::Drive::loads : continuum::Drive::rotation,
          .figure = figure};
}

}  // namespace pseudorigid::app
