#include "app/run/scene_to_model.h"

#include <Eigen/Core>
#include <numbers>
#include <optional>
#include <vector>

#include "entries/units.h"
#include "loads/list.h"
#include "materials/bulk_energy.h"
#include "materials/law_table.h"
#include "materials/rest_moduli.h"
#include "scene/bulk.h"
#include "scene/entries.h"
#include "scene/scales.h"
#include "scene/scene.h"

namespace pseudorigid::app {
namespace {

/// Convert the entries of a load from the user's units to internal units. Arrays are converted element by element. An
/// empty optional and a bool do not change.
void convert(const io::Units& units, scene::Unit unit, double& value) { value = units.to_internal(value, unit); }
void convert(const io::Units& units, scene::Unit unit, std::optional<double>& value) {
  if (value) convert(units, unit, *value);
}
void convert(const io::Units&, scene::Unit, bool&) {}
template <class Entries>
void convert(const io::Units& units, scene::Unit unit, Entries& values) {
  for (auto& value : values) convert(units, unit, value);
}
}  // namespace

Eigen::Vector3d to_eigen(const std::vector<double>& v) { return Eigen::Vector3d(v[0], v[1], v[2]); }

io::Units units_of(const scene::Scene& scene) {
  return io::ball_units(scene.body.radius, scene.body.density, scene::time_scale(scene));
}

Eigen::Matrix3d initial_deformation(const scene::Scene& scene) { return to_eigen(scene.initial_state.deformation); }

Eigen::Matrix3d initial_velocity(const scene::Scene& scene, const io::Units& units) {
  return to_eigen(scene.initial_state.velocity) * units.time;
}

Eigen::Vector3d initial_center(const scene::Scene& scene, const io::Units& units) {
  return to_eigen(scene.initial_state.center) / units.length;
}

Eigen::Vector3d initial_center_velocity(const scene::Scene& scene, const io::Units& units) {
  return to_eigen(scene.initial_state.center_velocity) / units.velocity();
}

loads::Loads internal_loads(const scene::Scene& scene) {
  const io::Units units = units_of(scene);
  loads::Loads loads = scene.loads;
  loads::visit_entries(
      loads, [&](auto& member, const auto&, const scene::About& about) { convert(units, about.unit, member); });
  return loads;
}

double rise_time(const scene::Scene& scene) { return internal_loads(scene).get<loads::Rise>().time; }

materials::AnyLaw internal_law(const scene::Scene& scene) {
  const scene::Scene::Material& material = scene.material;
  const double stress = units_of(scene).stress();
  const bool has_shear_waves = !scene::is_fluid(scene) && !loads::present(scene.loads.get<loads::SelfGravity>());
  const double mu = has_shear_waves ? 1.0 : material.shear_modulus / stress;
  materials::LawParameters internal = material;
  for (const materials::LawEntry& entry : materials::law_entries)
    if (entry.is_modulus) internal.*entry.member = mu * (material.*entry.member / material.shear_modulus);
  return materials::make_law(material.law, internal, scene.body.incompressible);
}

DiscreteLaw discrete_law(const scene::Scene& scene) {
  const materials::AnyLaw law = internal_law(scene);
  if (!scene::projects_bulk(scene)) return {law, 0};
  const materials::SplitLaw split = *materials::without_bulk(law);
  return {split.rest, split.lambda};
}

double gravity_to_elasticity(const scene::Scene& scene) {
  const double weight_of_density =
      4 * std::numbers::pi / 3 * loads::constant_forcing(internal_loads(scene)).gravity_constant;
  return weight_of_density / materials::moduli_at_rest(internal_law(scene), scene.body.incompressible).shear;
}

}  // namespace pseudorigid::app
