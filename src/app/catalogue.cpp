#include "app/catalogue.h"

#include "app/equilibria.h"
#include "app/scene_to_model.h"
#include "app/system_description.h"
#include "reduced/pseudo_rigid_body.h"
#include "systems/table.h"

namespace pseudorigid::app {
namespace {

template <class Law, bool incompressible>
using Body = reduced::PseudoRigidBody<Law, incompressible>;

/// The pseudo-rigid body with the method asked for.
std::optional<scene::Refusal> refuses_ball(const scene::Scene& scene) {
  const auto ball = reduced::ReferenceBody::unit_ball();
  return std::visit(
      [&]<class Law>(const Law& law) {
        return scene.body.incompressible ? refuses_method(scene, Body<Law, true>(law, ball))
                                         : refuses_method(scene, Body<Law, false>(law, ball));
      },
      internal_law(scene));
}

/// The finite-element ball has the form of the incompressible body, with vectors of its own.
using IncompressibleBody = Body<std::variant_alternative_t<0, materials::AnyLaw>, true>;
template <class Method>
constexpr bool for_continuum =
    mechanics::takes_any_vector<Method>&& mechanics::method_fits<Method, IncompressibleBody>();

scene::Catalogue make_catalogue() {
  scene::Catalogue catalogue{
      .methods = {}, .systems = {}, .refuses_ball = refuses_ball, .equilibria = equilibria_columns({}, 1)};
  mechanics::for_each_method([&]<class Method>(Method) {
    catalogue.methods.push_back({Method::name, Method::documentation, for_continuum<Method>});
  });
  systems::for_each_system(
      [&]<class SystemScene>(const SystemScene&) { catalogue.systems.push_back(describe_system<SystemScene>()); });
  return catalogue;
}

}  // namespace

const scene::Catalogue& program_catalogue() {
  static const scene::Catalogue catalogue = make_catalogue();
  return catalogue;
}

}  // namespace pseudorigid::app
