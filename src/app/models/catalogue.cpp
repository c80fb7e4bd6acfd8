#include "app/models/catalogue.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "app/systems/equilibria.h"
#include "app/systems/manifolds.h"
#include "app/systems/system_run.h"
#include "mechanics/methods/methods.h"
#include "systems/table.h"

namespace pseudorigid::app {
namespace {

/// True if the description has all the parts that a model must have (ball_models.h).
bool is_complete(const scene::ModelDescription& m) {
  return !m.name.empty() && !m.adjective.empty() && !m.documentation.empty() && !m.columns.empty() && m.header &&
         m.needed && m.skipped && m.refuses;
}

}  // namespace

BallModel::BallModel(scene::ModelDescription d, RunModel run_model, RunTogether run_together)
    : description(std::move(d)), run(run_model), together(run_together) {
  if (!is_complete(description) || (!run && !description.discretized))
    throw std::logic_error(
        fmt::format("the model \"{}\" leaves out a part of its description, or what runs it", description.name));
}

scene::Catalogue catalogue_with(const std::vector<BallModel>& models) {
  scene::Catalogue catalogue{.methods = {},
                             .models = {},
                             .systems = {},
                             .connections = connections_columns(),
                             .equilibria = equilibria_columns({}, 1)};
  mechanics::for_each_method([&]<class Method>(Method) {
    catalogue.methods.push_back({Method::name, Method::documentation});
  });
  for (const BallModel& model : models) catalogue.models.push_back(model.description);
  for (const auto& system : systems::system_table()) catalogue.systems.push_back(describe_system(system));
  return catalogue;
}

const scene::Catalogue& program_catalogue() {
  static const scene::Catalogue catalogue = catalogue_with(ball_models());
  return catalogue;
}

}  // namespace pseudorigid::app
