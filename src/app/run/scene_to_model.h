#pragma once
/// Conversion of the quantities of a scene from the user's units to internal units. The internal units are the radius
/// r, the mass ρr³ with the density ρ, and the unit of time of scene/scales.h.

#include <Eigen/Core>
#include <numbers>
#include <optional>
#include <vector>

#include "entries/units.h"
#include "loads/list.h"
#include "materials/law_table.h"
#include "materials/rest_moduli.h"
#include "scene/entries.h"
#include "scene/scales.h"
#include "scene/scene.h"

namespace pseudorigid::app {

using loads::to_eigen;
inline Eigen::Vector3d to_eigen(const std::vector<double>& v) { return Eigen::Vector3d(v[0], v[1], v[2]); }

/// The internal units of length, mass and time, measured in the user's units.
inline io::Units units_of(const scene::Scene& scene) {
  return io::ball_units(scene.body.radius, scene.body.density, scene::time_scale(scene));
}

/// The initial deformation Q₀ and its rate Q̇₀. The rate is per internal unit of time.
inline Eigen::Matrix3d initial_deformation(const scene::Scene& scene) {
  return to_eigen(scene.initial_state.deformation);
}
inline Eigen::Matrix3d initial_velocity(const scene::Scene& scene, const io::Units& units) {
  return to_eigen(scene.initial_state.velocity) * units.time;
}

/// The initial position and velocity of the centre of mass, in internal units.
inline Eigen::Vector3d initial_center(const scene::Scene& scene, const io::Units& units) {
  return to_eigen(scene.initial_state.center) / units.length;
}
inline Eigen::Vector3d initial_center_velocity(const scene::Scene& scene, const io::Units& units) {
  return to_eigen(scene.initial_state.center_velocity) / units.velocity();
}

namespace detail {
/// Convert the entries of a load from the user's units to internal units. Arrays are converted element by element; an
/// empty optional and a truth value do not change.
inline void convert(const io::Units& units, scene::Unit unit, double& value) { value = units.to_internal(value, unit); }
inline void convert(const io::Units& units, scene::Unit unit, std::optional<double>& value) {
  if (value) convert(units, unit, *value);
}
inline void convert(const io::Units&, scene::Unit, bool&) {}
template <class Entries>
void convert(const io::Units& units, scene::Unit unit, Entries& values) {
  for (auto& value : values) convert(units, unit, value);
}
}  // namespace detail

/// The loads of a scene, in internal units.
inline loads::Loads internal_loads(const scene::Scene& scene) {
  const io::Units units = units_of(scene);
  loads::Loads loads = scene.loads;
  loads::visit_entries(
      loads, [&](auto& member, const auto&, const scene::About& about) { detail::convert(units, about.unit, member); });
  return loads;
}

/// The time until which the loads rise, in internal units; 0 if they have their full strength from the start.
inline double rise_time(const scene::Scene& scene) { return internal_loads(scene).get<loads::Rise>().time; }

/// The material law in internal units. For a solid without self-gravity, the unit of time is r/c with the speed c of
/// shear waves, and the shear modulus is exactly 1.
inline materials::AnyLaw internal_law(const scene::Scene& scene) {
  const scene::Scene::Material& material = scene.material;
  const double stress = units_of(scene).stress();
  const bool has_shear_waves = !scene::is_fluid(scene) && !loads::present(scene.loads.get<loads::SelfGravity>());
  const double mu = has_shear_waves ? 1.0 : material.shear_modulus / stress;
  materials::LawParameters internal = material;
  for (const materials::LawEntry& entry : materials::law_entries)
    if (entry.is_modulus) internal.*entry.member = mu * (material.*entry.member / material.shear_modulus);
  return materials::make_law(material.law, internal, scene.body.incompressible);
}

/// The ratio γ = ρgr/μ of gravity to elasticity, with the density ρ, the radius r and the shear modulus μ at rest. The
/// gravity at the surface is g = (4/3)πGρr, with Newton's constant G.
inline double gravity_to_elasticity(const scene::Scene& scene) {
  const double weight_of_density =
      4 * std::numbers::pi / 3 * loads::constant_forcing(internal_loads(scene)).gravity_constant;
  return weight_of_density / materials::moduli_at_rest(internal_law(scene), scene.body.incompressible).shear;
}

}  // namespace pseudorigid::app
