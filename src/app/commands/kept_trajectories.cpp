#include "app/commands/kept_trajectories.h"

namespace pseudorigid::app {

std::vector<std::string> columns_of_run(const scene::Scene& scene, const scene::Needs& needs) {
  if (!needs.system) return needs.models.front()->header(needs.quantities);
  std::vector<std::string> names{"time"};
  for (const scene::Column& column : needs.system->columns_of(scene)) names.push_back(column.name);
  return names;
}

}  // namespace pseudorigid::app
