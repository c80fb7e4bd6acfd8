#pragma once
/// From the scene's values in the user's units to the models' values in internal units (length r, mass ρr³, time of
/// scene/scales.h).

#include <Eigen/Core>
#include <vector>

#include "io/units.h"
#include "materials/law_table.h"
#include "mechanics/by_name.h"
#include "scene/entries.h"
#include "scene/scales.h"
#include "scene/scene.h"

namespace pseudorigid::app {

inline Eigen::Matrix3d to_eigen(const scene::Matrix3& m) {
  Eigen::Matrix3d result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result(i, j) = m[i][j];
  return result;
}

inline Eigen::Vector3d to_eigen(const std::vector<double>& v) { return Eigen::Vector3d(v[0], v[1], v[2]); }

/// Length r, mass ρr³, time as scene/scales.h says.
inline io::Units units_of(const scene::Scene& scene) {
  return io::ball_units(scene.body.radius, scene.body.density, scene::time_scale(scene));
}

/// Q₀ and Q̇₀ (per internal time).
inline Eigen::Matrix3d initial_deformation(const scene::Scene& scene) {
  return to_eigen(scene.initial_state.deformation);
}
inline Eigen::Matrix3d initial_velocity(const scene::Scene& scene, const io::Units& units) {
  return to_eigen(scene.initial_state.velocity) * units.time;
}

/// What acts on the body besides its elasticity and its gravity, and how its centre of mass starts.
struct InternalLoads {
  ByName by_name{};
  Eigen::Matrix3d quadratic;         ///< T
  Eigen::Vector3d acceleration;      ///< b
  Eigen::Matrix3d nominal_traction;  ///< P̄
  double viscosity, drag;            ///< η, c
  Eigen::Vector3d center, center_velocity;
};
inline InternalLoads internal_loads(const scene::Scene& scene) {
  const io::Units units = units_of(scene);
  const double t = units.time;
  return {.quadratic = t * t * to_eigen(scene.loads.quadratic),
          .acceleration = to_eigen(scene.loads.acceleration) / (units.length / (t * t)),
          .nominal_traction = to_eigen(scene.loads.nominal_traction) / units.stress(),
          .viscosity = scene.dissipation.viscosity / (units.stress() * t),
          .drag = scene.dissipation.drag * t,
          .center = to_eigen(scene.initial_state.center) / units.length,
          .center_velocity = to_eigen(scene.initial_state.center_velocity) / units.velocity()};
}

/// The law in internal units: μ = 1 where the unit of time is that of shear waves, as it is without self-gravity.
inline materials::AnyLaw internal_law(const scene::Scene& scene) {
  const auto& material = scene.material;
  const double stress = units_of(scene).stress();
  const bool has_shear_waves = !scene::is_fluid(scene) && scene.gravity_constant == 0;
  const double mu = has_shear_waves ? 1.0 : material.shear_modulus / stress;
  return materials::make_law(scene::law_kind.print(material.law),
                             {.shear_modulus = mu,
                              .lame_lambda = mu * (material.lame_lambda / material.shear_modulus),
                              .incompressible = scene.body.incompressible,
                              .mooney_fraction = material.mooney_fraction,
                              .gent_limit = material.gent_limit});
}

}  // namespace pseudorigid::app
