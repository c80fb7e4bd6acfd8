#pragma once
/// The comparison of the models of a run. Each model is compared with the last one, which has the most degrees of
/// freedom. For two models the files are comparison.csv and comparison.json. For more, each comparison has its files
/// `comparison-<model>.csv` and .json, and comparison.json is an overview. A model that runs alone has a table on the
/// terminal.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "analysis/comparison.h"
#include "analysis/other_resolution.h"
#include "app/run/run_context.h"
#include "io/csv.h"

namespace pseudorigid::app {

/// For each model by its name, the motion on another discretisation.
using OtherResolutions = std::map<std::string, analysis::OtherResolution, std::less<>>;

/// A run of a model with its samples.
struct RunOfModel {
  const scene::ModelDescription* model;
  std::string name;  ///< name of its files
  std::string adjective;
  io::Manifest::Model statistics;
  io::Table table;
};

/// The adjective of the ball in a run, "elastic". If the run has chosen its degree, the text is "polynomial N = 7".
std::string adjective_of(const scene::ModelRun& run, const io::Manifest::Model& statistics);

/// The comparison of each run with the last one over the samples that all runs have; empty if there are fewer than two.
std::vector<analysis::Comparison> comparisons_of(const RunContext& context, std::vector<RunOfModel> runs,
                                                 const OtherResolutions& others);

/// Compares the models that ran, writes the files and prints a table. Returns the reason if printing fails, otherwise
/// an empty string.
std::string compare_models(const RunContext& context, const io::Manifest& manifest, const OtherResolutions& others,
                           bool quiet);

/// Prints a summary of the only model, or of the system. Returns the reason if printing fails, otherwise an empty
/// string.
std::string summarize_run(const RunContext& context, const io::Manifest& manifest, const OtherResolutions& others);

}  // namespace pseudorigid::app
