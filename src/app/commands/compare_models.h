#pragma once
/// The comparison of the models of a scene. A model can have several runs, for example one for each degree of the
/// polynomial model. Each run is compared with the last run, whose model has the most degrees of freedom. For two runs
/// the files are comparison.csv and comparison.json. For more runs, each comparison has the files
/// `comparison-<run>.csv` and `comparison-<run>.json`, with the name of the run that is compared with the last one. The
/// file comparison.json is then an overview. If a motion has only one run, the program prints a summary of this run on
/// the terminal.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "analysis/comparison.h"
#include "analysis/other_resolution.h"
#include "app/run/run_context.h"
#include "io/csv.h"

namespace pseudorigid::app {

/// Maps the name of a model to the motion of its last run on another discretisation. The difference between the
/// frequencies of both motions gives the error in space of the frequency.
using OtherResolutions = std::map<std::string, analysis::OtherResolution, std::less<>>;

/// A run of a model, with the table of its samples.
struct RunOfModel {
  const scene::ModelDescription* model;
  std::string name;                ///< name of the files of the run
  std::string adjective;           ///< adjective of the ball in tables and sentences (`adjective_of`)
  io::Manifest::Model statistics;  ///< counters of the run, among them its estimated errors
  io::Table table;                 ///< samples of the run
};

/// The adjective of the ball in a run for tables and sentences, for example "elastic". If the program has chosen the
/// degree N of the run, the adjective contains N, for example "polynomial N = 7". N is the counter `degree` of
/// `statistics`. Without this counter the adjective does not contain N.
std::string adjective_of(const scene::ModelRun& run, const io::Manifest::Model& statistics);

/// Compares each run with the last run, at the samples that all runs have. Returns a comparison for each run except the
/// last, in the order of the runs. Returns an empty vector if there are fewer than two runs, or fewer than two common
/// samples. Throws UserError for the reasons of analysis::compare.
std::vector<analysis::Comparison> comparisons_of(const RunContext& context, std::vector<RunOfModel> runs,
                                                 const OtherResolutions& others);

/// Compares the runs that have an entry in the manifest. Writes the comparison files, and prints a table unless `quiet`
/// is true. Logs a warning for each model whose energy changes by more than its bound (analysis/motion.h). Does nothing
/// for fewer than two runs, or fewer than two common samples. Returns the reason if printing fails, otherwise an empty
/// string. Throws UserError for the reasons of analysis::compare, and io::WriteError if a file cannot be written.
std::string compare_models(const RunContext& context, const io::Manifest& manifest, const OtherResolutions& others,
                           bool quiet);

/// Prints a summary of the motion of the system, or of the last run of the only model. Logs a warning if its energy
/// changes by more than its bound (analysis/motion.h). Does nothing if there are several models, no CSV file or fewer
/// than two samples. Returns the reason if printing fails, otherwise an empty string.
std::string summarize_run(const RunContext& context, const io::Manifest& manifest, const OtherResolutions& others);

}  // namespace pseudorigid::app
