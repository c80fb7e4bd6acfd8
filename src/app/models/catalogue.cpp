#include "app/models/catalogue.h"

#include "app/models/ball_models.h"
#include "app/reduced/reduced_scene.h"
#include "app/systems/equilibria.h"
#include "app/systems/manifolds.h"
#include "app/systems/system_run.h"
#include "mechanics/core/field_of.h"
#include "mechanics/methods/methods.h"
#include "systems/table.h"

namespace pseudorigid::app {
namespace {

/// The finite-element ball has the form of the incompressible body, with vectors of its own.
template <class Method>
constexpr bool for_discretized =
    mechanics::takes_any_vector<Method>&& mechanics::method_fits<Method, ElasticBody<true>>();

scene::Catalogue make_catalogue() {
  scene::Catalogue catalogue{.methods = {},
                             .models = {},
                             .systems = {},
                             .connections = connections_columns(),
                             .equilibria = equilibria_columns({}, 1)};
  mechanics::for_each_method([&]<class Method>(Method) {
    catalogue.methods.push_back({Method::name, Method::documentation, for_discretized<Method>});
  });
  for (const auto describe : ball_models) catalogue.models.push_back(describe());
  for (const auto& system : systems::system_table()) catalogue.systems.push_back(describe_system(system));
  return catalogue;
}

}  // namespace

const scene::Catalogue& program_catalogue() {
  static const scene::Catalogue catalogue = make_catalogue();
  return catalogue;
}

}  // namespace pseudorigid::app
