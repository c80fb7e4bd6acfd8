#pragma once
/// Sweep/Trajectories: besides sweep.csv all samples of all runs in one table, trajectories.csv, with the number of the
/// run before the columns of the model's own file.

#include <string>
#include <vector>

#include "io/run_directory.h"
#include "scene/needs.h"
#include "scene/read_scene.h"

namespace pseudorigid::app {

inline constexpr const char* trajectories_name = "trajectories";

/// The columns of the file that one run of a sweep would write.
std::vector<std::string> columns_of_run(const scene::Scene& scene, const scene::Needs& needs);

/// UserError where the table would not find room on the disk of the directory, which need not exist yet.
void require_room_for_trajectories(const scene::Scene& scene, const scene::Origins& origins,
                                   const io::RunDirectory& directory);

}  // namespace pseudorigid::app
