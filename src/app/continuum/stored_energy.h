#pragma once
/// Conversion of the material of a scene to the stored energy of the finite elements, in internal units.

#include "app/run/scene_to_model.h"
#include "continuum/kernels/stored_energy.h"
#include "scene/stabilization.h"

namespace pseudorigid::app {

/// The stored energy of the elements: the law with its projected bulk term, and the volumetric stiffness
/// (scene/stabilization.h).
inline continuum::StoredEnergy stored_energy(const scene::Scene& scene) {
  const double kappa = scene::volumetric_stiffness_of_elements(scene) / units_of(scene).stress();
  const DiscreteLaw law = discrete_law(scene);
  return {law.law, kappa, law.projected_bulk};
}

}  // namespace pseudorigid::app
