#include "app/commands/kept_trajectories.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "scene/user_error.h"

namespace pseudorigid::app {
namespace {

namespace fs = std::filesystem;

/// Of a number of 17 digits: sign, point, exponent and comma with it.
constexpr double bytes_per_value = 24;

fs::path nearest_existing(fs::path path) {
  std::error_code error;
  path = fs::absolute(path, error);
  while (!fs::exists(path, error) && path.has_relative_path()) path = path.parent_path();
  return path;
}

}  // namespace

std::vector<std::string> columns_of_run(const scene::Scene& scene, const scene::Needs& needs) {
  if (!needs.system) return needs.models.front()->header(needs.quantities);
  std::vector<std::string> names{"time"};
  for (const scene::Column& column : needs.system->columns_of(scene)) names.push_back(column.name);
  return names;
}

void require_room_for_trajectories(const scene::Scene& scene, const scene::Origins& origins,
                                   const io::RunDirectory& directory) {
  if (scene.sweep.empty() || !scene.sweep_trajectories) return;
  const auto n_columns = static_cast<double>(columns_of_run(scene, scene::needs(scene)).size() + 1);
  const double n_rows = static_cast<double>(scene::n_runs(scene.sweep)) * (scene.output.samples + 1.0),
               needed = n_rows * n_columns * bytes_per_value;
  std::error_code error;
  const fs::space_info space = fs::space(nearest_existing(directory.path()), error);
  if (error) return;  // what is wrong with the place is said where the directory is made
  const auto there = fs::file_size(directory.csv(trajectories_name), error);
  const double room = static_cast<double>(space.available) + (error ? 0.0 : static_cast<double>(there));
  constexpr double mega = 1e6;
  if (needed > room)
    throw UserError(fmt::format(
        "{}: Sweep/Trajectories: {:.3g} rows of {} columns would take up to {:.3g} MB, and {:.3g} MB are free on the "
        "disk of {}; set false, or fewer runs, Output/Samples or columns",
        origins.of("Sweep/Trajectories"), n_rows, n_columns, needed / mega, room / mega, directory.path().string()));
}

}  // namespace pseudorigid::app
