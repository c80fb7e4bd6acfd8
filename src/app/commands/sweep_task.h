#pragma once
/// Interface to the runs k = 0, 1, … of a sweep. An implementation gives the columns of sweep.csv and computes the row
/// of each run.

#include <optional>
#include <string>
#include <vector>

#include "io/csv.h"
#include "mechanics/core/outcome.h"

namespace pseudorigid::app {

/// The row and the outcome of a run.
struct FinishedRun {
  std::vector<double> row;  ///< row of sweep.csv
  io::Table samples;        ///< samples, if Sweep/Trajectories is true and the sweep has one model; otherwise empty
  mechanics::Outcome end = mechanics::Outcome::finished;
  std::string message;  ///< the reason why the run has not finished; empty for a finished run
};

class SweepTask {
 public:
  virtual ~SweepTask() = default;

  /// The names of the columns of sweep.csv, in the order of FinishedRun::row.
  virtual std::vector<std::string> columns() const = 0;
  /// Computes run k. Several threads call this function at the same time. Throws UserError if the scene of the run is
  /// not valid.
  virtual FinishedRun run(int k) const = 0;
  /// Number of runs that a thread takes at a time. More than 1 only for run_together, because threads share the last
  /// runs of a sweep best if they take them one by one.
  virtual int group_size() const { return 1; }
  /// Computes the runs first, …, last − 1 at the same time, in SIMD lanes, and returns them in this order. Returns an
  /// empty value if a caller must compute each run separately.
  virtual std::optional<std::vector<FinishedRun>> run_together(int /*first*/, int /*last*/) const { return {}; }
};

}  // namespace pseudorigid::app
