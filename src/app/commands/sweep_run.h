#pragma once
/// One run of a sweep, and its row of sweep.csv (sweep.h).

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/models/ball_models.h"
#include "app/run/model_sink.h"
#include "app/run/run_context.h"
#include "io/log.h"
#include "scene/read_scene.h"
#include "scene/sweep.h"

namespace pseudorigid::app {

/// "mu = 0.5, k = 2".
std::string describe_values(const scene::ParameterValues& values);

/// The scene of a run with these parameters, checked. Throws UserError if it cannot run.
scene::Scene scene_of_run(const scene::ReadScene& raw, const scene::ParameterValues& values);

/// The runs in which each parameter has its first or its last value.
std::set<int> corners(const scene::Sweep& sweep);

/// Names of the ball's columns that a motion conserves.
std::set<std::string> names_conserved(bool is_free, bool incompressible);

/// Columns of the frequencies of the ball.
std::vector<std::string> columns_of_frequencies();

/// The columns of sweep.csv.
std::vector<std::string> columns_of_sweep(const scene::Scene& scene, const scene::Needs& needs,
                                          const std::set<std::string>& conserved);

/// The samples of a run, and its end.
struct RunResult {
  io::Table rows;
  ModelOutcome outcome;
};

class SweepRun {
 public:
  SweepRun(const scene::ReadScene& raw, RunModel run, RunTogether together, const RunContext& context);

  RunResult run(int k) const;
  /// The runs first, …, last − 1 at once, or no value if each has to run by itself.
  std::optional<std::vector<RunResult>> run_together(int first, int last) const;

  std::vector<std::string> columns() const { return columns_of_sweep(context_.scene, context_.needs, conserved_); }
  std::vector<double> row(int k, const RunResult& result) const;

 private:
  RunContext context_of(const scene::Scene& scene, RunResult& result) const;
  void add_frequency(const io::Table& table, std::vector<double>& row) const;

  const scene::ReadScene& raw_;
  RunModel run_;
  RunTogether together_;
  const RunContext& context_;
  std::set<std::string> conserved_;
  std::shared_ptr<io::Logger> silent_;
};

}  // namespace pseudorigid::app
