#pragma once
/// Sweep/Trajectories: in addition to sweep.csv, all samples of all runs in one table, trajectories.csv, with the
/// number of the run before the columns of the model's own file.

#include <string>
#include <vector>

#include "scene/needs.h"
#include "scene/scene.h"

namespace pseudorigid::app {

inline constexpr const char* trajectories_name = "trajectories";

/// The columns of the file that one run of a sweep would write.
std::vector<std::string> columns_of_run(const scene::Scene& scene, const scene::Needs& needs);

}  // namespace pseudorigid::app
