#pragma once
/// The runs of a sweep in which every model of the scene runs. The tables of the models of a run are in memory. The
/// derived class makes a row of sweep.csv from these tables.

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands/program.h"
#include "app/commands/sweep_task.h"
#include "app/run/run_context.h"
#include "io/csv.h"
#include "scene/read_scene.h"

namespace pseudorigid::app {

/// The prefix of the names of a run's columns in sweep.csv. It is the name of the run's files with "_" in place of "-",
/// followed by "_".
std::string column_prefix(std::string_view run);

/// The columns that precede the results: "run" and the parameters of the sweep.
std::vector<std::string> first_columns(const scene::Scene& scene);

/// Base class of ComparedRuns and TableRuns, which define the columns and the results.
class ModelRuns : public SweepTask {
 public:
  /// `context` is the context of the first run of the sweep. All three arguments must exist as long as the object.
  ModelRuns(const scene::ReadScene& raw, const Executable& executable, const RunContext& context)
      : executable_(executable), context_(context), raw_(raw), silent_(io::make_logger(io::Verbosity::silent, {})) {}

  std::vector<std::string> columns() const final { return columns_of(context_.scene, context_.needs); }
  FinishedRun run(int k) const final;

 protected:
  /// Maps the name of a model's file, without ".csv", to its table.
  using Tables = std::map<std::string, io::Table>;

  const Executable& executable_;

 private:
  /// The names of the columns of sweep.csv for the scene of a run. If they differ from those of the first run, run(k)
  /// throws UserError.
  virtual std::vector<std::string> columns_of(const scene::Scene& scene, const scene::Needs& needs) const = 0;

  /// Runs the models in `context`, and sets the outcome and the message of `run`. The models write their tables into
  /// `tables`. The row of `run` has the values of first_columns. The function appends the results to this row, unless
  /// the run is interrupted. A caller does not use the row of an interrupted run.
  virtual void compute(const RunContext& context, Tables& tables, FinishedRun& run) const = 0;

  const RunContext& context_;
  const scene::ReadScene& raw_;
  std::shared_ptr<io::Logger> silent_;  ///< log without output
};

/// Adds the outcome of a model to the outcome `end` and the message of a run of the sweep. If the model has not
/// finished, `end` becomes the outcome of the model, and its message is appended. If the model has finished, neither of
/// them changes. Returns true if the model was interrupted.
bool add_outcome(const ModelOutcome& outcome, mechanics::Outcome& end, std::string& message);

}  // namespace pseudorigid::app
