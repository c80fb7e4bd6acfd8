#pragma once
/// From the scene's values in the user's units to the models' values in internal units (length r, mass ρr³, time r/c).

#include <Eigen/Core>
#include <optional>

#include "io/units.h"
#include "materials/law_table.h"
#include "mechanics/methods.h"
#include "scene/entries.h"
#include "scene/scene.h"

namespace pseudorigid::app {

inline Eigen::Matrix3d to_eigen(const scene::Matrix3& m) {
  Eigen::Matrix3d result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result(i, j) = m[i][j];
  return result;
}

/// Q₀ and Q̇₀ (per internal time).
inline Eigen::Matrix3d initial_deformation(const scene::Scene& scene) {
  return to_eigen(scene.initial_state.deformation);
}
inline Eigen::Matrix3d initial_velocity(const scene::Scene& scene, const io::Units& units) {
  return to_eigen(scene.initial_state.velocity) * units.time;
}

/// The law with μ = 1.
inline materials::AnyLaw internal_law(const scene::Scene& scene) {
  const auto& [law, shear_modulus, lame_lambda, mooney_fraction] = scene.material;
  return materials::make_law(scene::law_kind.print(law),
                             {1.0, lame_lambda / shear_modulus, scene.body.incompressible, mooney_fraction});
}

/// Empty for `auto`.
inline std::optional<mechanics::MethodId> method_of(const scene::Scene& scene) {
  return mechanics::find_method(scene.time.method);
}

}  // namespace pseudorigid::app
