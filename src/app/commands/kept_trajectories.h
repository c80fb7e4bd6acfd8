#pragma once
/// The table trajectories.csv, which a sweep writes if Sweep/Trajectories is true. The table has all samples of all
/// runs. Its columns are the number of the run, and then the columns of the file that a single run writes.

#include <string>
#include <vector>

#include "scene/needs.h"
#include "scene/scene.h"

namespace pseudorigid::app {

/// Name of the table without ".csv".
inline constexpr const char* trajectories_name = "trajectories";

/// The names of the columns of the CSV file that a single run of the scene would write. If the scene has models of the
/// ball, it is the file of the first model, because only sweeps with one model write their samples.
std::vector<std::string> columns_of_run(const scene::Scene& scene, const scene::Needs& needs);

}  // namespace pseudorigid::app
