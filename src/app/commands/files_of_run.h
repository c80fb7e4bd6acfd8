#pragma once
/// The names of the files and checkpoints that a run can write.

#include <string>
#include <vector>

#include "app/commands/sweep_rows.h"
#include "app/polynomial/degree_search.h"
#include "app/search/discretization_search.h"
#include "scene/catalogue.h"

namespace pseudorigid::app {

/// The names, without extensions, of the files of all models and systems of the catalogue. A model with several runs
/// has a name for each possible run, for example "polynomial-3".
inline std::vector<std::string> movers(const scene::Catalogue& catalogue) {
  std::vector<std::string> names;
  for (const scene::ModelDescription& model : catalogue.models) {
    names.emplace_back(model.name);
    names.insert(names.end(), model.rungs.begin(), model.rungs.end());
  }
  for (const scene::SystemDescription& system : catalogue.systems) names.emplace_back(system.file);
  return names;
}

/// The names of the checkpoints that a run can write. Models, their families of equilibria, systems and sweeps have
/// checkpoints, and so do the two searches for a discretisation and a degree.
inline std::vector<std::string> writers_of_checkpoints(const scene::Catalogue& catalogue) {
  std::vector<std::string> names = movers(catalogue);
  for (const scene::ModelDescription& model : catalogue.models) names.emplace_back(model.equilibria.file);
  names.insert(names.end(), {SweepRows::name, DiscretizationSearch::checkpoint_name, degree_checkpoint_name});
  return names;
}

}  // namespace pseudorigid::app
