#include "app/reduced_scene.h"

#include "app/scene_to_model.h"
#include "scene/scales.h"
#include "scene/sector.h"

namespace pseudorigid::app {
namespace {

reduced::ReferenceBody reference_body(const scene::Scene& scene, const io::Units& units) {
  const auto body = reduced::ReferenceBody::ellipsoid(to_eigen(scene.body.semi_axes));
  if (!scene.body.inertia) return body;
  const double unit = units.mass * units.length * units.length;
  return reduced::ReferenceBody::of_inertia(to_eigen(*scene.body.inertia) / unit, body.volume);
}

}  // namespace

ReducedScene reduced_scene(const scene::Scene& scene) {
  const io::Units units = units_of(scene);
  const InternalLoads loads = internal_loads(scene);
  return {.law = internal_law(scene),
          .body = reference_body(scene, units),
          .loads = {.gravity_constant = scene.gravity_constant * scene.body.density * units.time * units.time,
                    .quadratic = loads.quadratic,
                    .nominal_traction = loads.nominal_traction},
          .dissipation = {.viscosity = loads.viscosity, .drag = loads.drag},
          .center = {.position = loads.center,
                     .velocity = loads.center_velocity,
                     .acceleration = loads.acceleration,
                     .quadratic = loads.quadratic,
                     .drag = loads.drag},
          .start = {0, initial_deformation(scene), initial_velocity(scene, units)},
          .keeps_diagonal = scene::keeps_diagonal(scene)};
}

ReducedForm form_of(const ReducedScene& s) {
  if (s.dissipation.present()) return ReducedForm::dissipative;
  if (s.keeps_diagonal) return ReducedForm::diagonal;
  const bool plain = s.loads.gravity_constant == 0 && s.loads.quadratic.isZero(0) && s.loads.nominal_traction.isZero(0);
  return plain && std::holds_alternative<materials::CiarletGeymonat>(s.law) ? ReducedForm::elastic
                                                                            : ReducedForm::general;
}

}  // namespace pseudorigid::app
