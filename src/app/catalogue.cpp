#include "app/catalogue.h"

#include "app/ball_equilibria.h"
#include "app/equilibria.h"
#include "app/reduced_scene.h"
#include "app/refuses_method.h"
#include "app/system_run.h"
#include "materials/eigen_tensor.h"
#include "systems/table.h"

namespace pseudorigid::app {
namespace {

/// The pseudo-rigid body, in the form that the scene takes, with the method asked for.
template <bool incompressible>
std::optional<scene::Refusal> refuses_body(const scene::Scene& scene) {
  const ReducedScene s = reduced_scene(scene);
  if (!materials::admits(s.law, materials::to_tensor(s.start.q)))
    return scene::Refusal{"Initial state/Deformation", materials::beyond_limit(materials::limit_of(s.law))};
  switch (form_of(s)) {
    case ReducedForm::elastic:
    case ReducedForm::general:
      return refuses_method(scene, general_body<incompressible>(s));
    case ReducedForm::diagonal:
      return refuses_method(scene, system_of<ReducedForm::diagonal, incompressible>(s));
    case ReducedForm::dissipative:
      return refuses_method(scene, system_of<ReducedForm::dissipative, incompressible>(s));
  }
  return {};
}

std::optional<scene::Refusal> refuses_ball(const scene::Scene& scene) {
  return scene.body.incompressible ? refuses_body<true>(scene) : refuses_body<false>(scene);
}

/// The finite-element ball has the form of the incompressible body, with vectors of its own.
template <class Method>
constexpr bool for_continuum =
    mechanics::takes_any_vector<Method>&& mechanics::method_fits<Method, ElasticBody<true>>();

scene::Catalogue make_catalogue() {
  scene::Catalogue catalogue{.methods = {},
                             .systems = {},
                             .refuses_ball = refuses_ball,
                             .equilibria = equilibria_columns({}, 1),
                             .ball_equilibria = ball_equilibria_columns()};
  mechanics::for_each_method([&]<class Method>(Method) {
    catalogue.methods.push_back({Method::name, Method::documentation, for_continuum<Method>});
  });
  for (const auto& system : systems::system_table()) catalogue.systems.push_back(describe_system(system));
  return catalogue;
}

}  // namespace

const scene::Catalogue& program_catalogue() {
  static const scene::Catalogue catalogue = make_catalogue();
  return catalogue;
}

}  // namespace pseudorigid::app
