#pragma once
/// Work of a sweep: its columns, and the row of each of its runs k = 0, 1, …

#include <optional>
#include <string>
#include <vector>

#include "io/csv.h"
#include "mechanics/core/outcome.h"

namespace pseudorigid::app {

/// The row of a run, and how the run ended.
struct FinishedRun {
  std::vector<double> row;  ///< of sweep.csv
  io::Table samples;        ///< of a run of one model, if they are kept
  mechanics::Outcome end = mechanics::Outcome::finished;
  std::string message;  ///< one sentence, if not finished
};

class SweepTask {
 public:
  virtual ~SweepTask() = default;

  virtual std::vector<std::string> columns() const = 0;
  /// Called by several threads. Throws UserError if the scene of the run is none.
  virtual FinishedRun run(int k) const = 0;
  /// The runs first, …, last − 1 at once, or no value if each has to run by itself.
  virtual std::optional<std::vector<FinishedRun>> run_together(int /*first*/, int /*last*/) const { return {}; }
};

}  // namespace pseudorigid::app
