#pragma once
/// Conversion of the material of a scene to the stored energy of the finite elements, in internal units.

#include "app/run/scene_to_model.h"
#include "continuum/kernels/stored_energy.h"
#include "scene/stabilization.h"

namespace pseudorigid::app {

/// The stored energy of the elements: the law and the volumetric stiffness (scene/stabilization.h).
inline continuum::StoredEnergy stored_energy(const scene::Scene& scene) {
  return {internal_law(scene), scene::volumetric_stiffness_of_elements(scene) / units_of(scene).stress()};
}

}  // namespace pseudorigid::app
