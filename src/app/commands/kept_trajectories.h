#pragma once
/// The table trajectories.csv of a sweep with Sweep/Trajectories. It has all samples of all runs. The number of the run
/// precedes the columns of the model's own file.

#include <string>
#include <vector>

#include "scene/needs.h"
#include "scene/scene.h"

namespace pseudorigid::app {

inline constexpr const char* trajectories_name = "trajectories";

/// The columns of the file that one run of a sweep would write.
std::vector<std::string> columns_of_run(const scene::Scene& scene, const scene::Needs& needs);

}  // namespace pseudorigid::app
