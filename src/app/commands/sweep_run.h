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

/// The parameters of a run as text, for example "mu = 0.5, k = 2".
std::string describe_values(const scene::ParameterValues& values);

/// The validated scene of a run with these parameters. Throws UserError if the scene cannot run.
scene::Scene scene_of_run(const scene::ReadScene& raw, const scene::ParameterValues& values);

/// The numbers of the runs in which each parameter has its first or its last value. For parameters of a Latin
/// hypercube, these are the first and the last point of the hypercube.
std::set<int> corners(const scene::Sweep& sweep);

/// Names of the columns of the ball that the motion conserves. The energy is always conserved, the momenta if
/// `is_free`, and the volume if `incompressible`.
std::set<std::string> names_conserved(bool is_free, bool incompressible);

/// Names of the two columns "frequency" and "amplitude" of the ball.
std::vector<std::string> columns_of_frequencies();

/// The columns of sweep.csv for one model or system. The names in `conserved` have a value and a drift.
std::vector<std::string> columns_of_sweep(const scene::Scene& scene, const scene::Needs& needs,
                                          const std::set<std::string>& conserved);

class SweepRun : public SweepTask {
 public:
  SweepRun(const scene::ReadScene& raw, RunModel run, RunTogether together, const RunContext& context);

  std::vector<std::string> columns() const override {
    return columns_of_sweep(context_.scene, context_.needs, conserved_);
  }
  FinishedRun run(int k) const override;
  std::optional<std::vector<FinishedRun>> run_together(int first, int last) const override;

 private:
  /// The rows and the outcome of one run.
  struct Result {
    io::Table rows;
    ModelOutcome outcome;
  };

  RunContext context_of(const scene::Scene& scene, Result& result) const;
  FinishedRun finished(int k, Result result) const;
  std::vector<double> row(int k, const Result& result) const;
  void add_frequency(const io::Table& table, std::vector<double>& row) const;

  const scene::ReadScene& raw_;
  RunModel run_;
  RunTogether together_;
  const RunContext& context_;
  std::set<std::string> conserved_;
  std::shared_ptr<io::Logger> silent_;
};

}  // namespace pseudorigid::app
