#include "app/reduced/reduced_scene.h"

#include "app/run/scene_to_model.h"
#include "scene/scales.h"
#include "scene/sector.h"

namespace pseudorigid::app {
namespace {

/// The body of the entry Body/Inertia if the scene gives it, otherwise the ellipsoid of Body/Semi-axes; in internal
/// units.
reduced::ReferenceBody reference_body(const scene::Scene& scene, const io::Units& units) {
  const auto body = reduced::ReferenceBody::ellipsoid(to_eigen(scene.body.semi_axes));
  if (!scene.body.inertia) return body;
  const double unit = units.mass * units.length * units.length;
  return reduced::ReferenceBody::of_inertia(to_eigen(*scene.body.inertia) / unit, body.volume);
}

}  // namespace

ReducedScene reduced_scene(const scene::Scene& scene) {
  const io::Units units = units_of(scene);
  loads::Loads loads = internal_loads(scene);
  if (scene.body.incompressible) loads = loads::at_constant_volume(loads);
  const loads::Forcing forcing = loads::constant_forcing(loads);
  return {.law = internal_law(scene),
          .body = reference_body(scene, units),
          .loads = loads,
          .forcing = forcing,
          .dissipation = reduced::Dissipation::of(forcing),
          .center = {.position = initial_center(scene, units),
                     .velocity = initial_center_velocity(scene, units),
                     .acceleration = forcing.acceleration,
                     .quadratic = forcing.quadratic,
                     .drag = forcing.drag,
                     .driving = loads},
          .start = {0, initial_deformation(scene), initial_velocity(scene, units)},
          .keeps_diagonal = scene::keeps_diagonal(scene)};
}

ReducedForm form_of(const ReducedScene& s) {
  if (!s.forcing.planes.empty() || !s.forcing.companions.empty() || !s.forcing.branches.empty())
    return ReducedForm::loaded;
  if (s.dissipation.present() || loads::depend_on_time(s.loads)) return ReducedForm::dissipative;
  if (s.keeps_diagonal) return ReducedForm::diagonal;
  const bool plain = s.forcing.gravity_constant == 0 && !reduced::ExternalPotential(s.forcing).present();
  return plain && std::holds_alternative<materials::CiarletGeymonat>(s.law) ? ReducedForm::elastic
                                                                            : ReducedForm::general;
}

}  // namespace pseudorigid::app
