#pragma once
/// The comparison of the models of a run: each with the last of them, which has the most motions. For two models the
/// files are comparison.csv and comparison.json; for more, `comparison-<model>.csv` and .json for each, and
/// comparison.json has an overview of them. A model that runs alone has a table of its own.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "analysis/comparison.h"
#include "analysis/other_resolution.h"
#include "app/run/run_context.h"
#include "io/csv.h"

namespace pseudorigid::app {

/// By the names of models: the same motion on another discretisation.
using OtherResolutions = std::map<std::string, analysis::OtherResolution, std::less<>>;

/// A run of a model, and its samples.
struct RunOfModel {
  const scene::ModelDescription* model;
  std::string name;  ///< of its files
  std::string adjective;
  io::Manifest::Model statistics;
  io::Table table;
};

/// The adjective of the ball of a run, with the degree that the run has found.
std::string adjective_of(const scene::ModelRun& run, const io::Manifest::Model& statistics);

/// Each run with the last of them, over the samples that all have; nothing if these are fewer than two.
std::vector<analysis::Comparison> comparisons_of(const RunContext& context, std::vector<RunOfModel> runs,
                                                 const OtherResolutions& others);

/// Compares the results of the models that ran. Returns why the table could not be printed, if it could not; it is
/// in the files as well.
std::string compare_models(const RunContext& context, const io::Manifest& manifest, const OtherResolutions& others,
                           bool quiet);

/// Prints the results of the only model, or of the system. The return value is the same.
std::string summarize_run(const RunContext& context, const io::Manifest& manifest, const OtherResolutions& others);

}  // namespace pseudorigid::app
