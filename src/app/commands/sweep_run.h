#pragma once
/// The runs of a sweep with one model or system, and their rows in sweep.csv (sweep.h).

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/commands/sweep_task.h"
#include "app/models/ball_models.h"
#include "app/run/model_sink.h"
#include "app/run/run_context.h"
#include "io/log.h"
#include "scene/read_scene.h"
#include "scene/sweep.h"

namespace pseudorigid::app {

/// The parameters of a run as text in alphabetical order, for example "k = 2, mu = 0.5".
std::string describe_values(const scene::ParameterValues& values);

/// The validated scene of a run with these parameters. Throws UserError if the scene cannot run.
scene::Scene scene_of_run(const scene::ReadScene& raw, const scene::ParameterValues& values);

/// The numbers, from 0, of the runs in which every parameter has its first or its last value, in all combinations.
/// Parameters of a Latin hypercube vary together: they have the values of its first or its last point.
std::set<int> corners(const scene::Sweep& sweep);

/// Names of the columns of the ball that the motion conserves. The energy, which includes the energies of loads and
/// dissipation, is always conserved. If `is_free` is true, no load acts, and angular momentum J and circulation Z are
/// conserved. The volume is conserved if `incompressible` is true.
std::set<std::string> names_conserved(bool is_free, bool incompressible);

/// The names "frequency" and "amplitude" of two columns of sweep.csv. Only sweeps of the ball have these columns, and
/// only if the files of the ball have the columns Q11 to Q33 of the deformation Q.
std::vector<std::string> columns_of_frequencies();

/// The names of the columns of sweep.csv for one model or system (sweep.h). Two columns have the initial value and the
/// drift of a column in `conserved`. For any other column of the model or system, three columns have the last, the
/// least and the greatest value.
std::vector<std::string> columns_of_sweep(const scene::Scene& scene, const scene::Needs& needs,
                                          const std::set<std::string>& conserved);

/// The runs of a sweep as tasks, each with one model or system. Runs together in SIMD lanes are possible if the model
/// offers them and Sweep/Lanes is true.
class SweepRun : public SweepTask {
 public:
  /// `together` is null if the model does not offer runs in SIMD lanes. `raw` and `context` must exist as long as the
  /// object. `context` is the context of the first run of the sweep.
  SweepRun(const scene::ReadScene& raw, RunModel run, RunTogether together, const RunContext& context);

  std::vector<std::string> columns() const override {
    return columns_of_sweep(context_.scene, context_.needs, conserved_);
  }
  FinishedRun run(int k) const override;
  int group_size() const override { return together_ ? n_lanes : 1; }
  std::optional<std::vector<FinishedRun>> run_together(int first, int last) const override;

 private:
  static constexpr int n_lanes = 8;  ///< lanes of `together` (app/reduced/reduced_in_lanes.h)

  /// The rows and the outcome of one run.
  struct Result {
    io::Table rows;
    ModelOutcome outcome;
  };

  /// The context of a run that does not write files or a log. The rows of the run are stored in `result`.
  RunContext context_of(const scene::Scene& scene, Result& result) const;
  /// The row of run k, with its samples if Sweep/Trajectories is true.
  FinishedRun finished(int k, Result result) const;
  /// The row of run k in sweep.csv. Values that depend on samples are 0 if the run has none.
  std::vector<double> row(int k, const Result& result) const;
  /// Appends the frequency and the amplitude of C = QᵀQ (analysis/motion.h) to the row, with the deformation Q. The
  /// frequency is 0 if none is found. Both numbers are 0 if there are fewer than two samples.
  void add_frequency(const io::Table& table, std::vector<double>& row) const;

  const scene::ReadScene& raw_;
  RunModel run_;
  RunTogether together_;
  const RunContext& context_;
  std::set<std::string> conserved_;     ///< columns that the motion conserves in all runs of `corners`
  std::shared_ptr<io::Logger> silent_;  ///< log without output
};

}  // namespace pseudorigid::app
