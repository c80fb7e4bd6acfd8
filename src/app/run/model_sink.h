#pragma once
/// Receiver of the results of one model's run. The base class discards all results. It serves runs of which only the
/// affine part of the motion is used (search/silent_run.h). This part does not pass through a sink. `RowsInMemory`
/// stores the rows in memory, for sweeps. `ModelFiles` writes files into the directory of the run.
///
/// All ranks call the same functions in the same order.

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/checkpoint.h"
#include "io/csv.h"
#include "mechanics/core/status.h"

namespace pseudorigid::app {

/// Functions that a run calls with its results. By default they discard the results.
class ModelSink {
 public:
  using Rows = std::vector<std::vector<double>>;
  /// A function that writes a picture into the file of the given path. Collective.
  using Draw = std::function<mechanics::Status(const std::filesystem::path&)>;

  virtual ~ModelSink() = default;

  /// Creates the table of rows with these columns. A resumed run calls `resume` instead.
  virtual void create(const std::vector<std::string>& /*columns*/) {}
  /// Appends the row of a sample, in the user's units. Requires an earlier call of `create` or `resume`.
  virtual void append(const std::vector<double>& /*row*/) {}

  /// True if the sink writes checkpoints, from which a stopped run can continue.
  virtual bool keeps_states() const { return false; }
  /// Writes the checkpoint that the function `checkpoint` returns. A sink that does not write checkpoints does not call
  /// `checkpoint`.
  virtual void save(const std::function<io::Checkpoint()>& /*checkpoint*/) {}
  /// The checkpoint from which this run continues; empty if the run begins at the start.
  virtual std::optional<io::Checkpoint> state_to_resume() { return std::nullopt; }
  /// Continues the table of rows after its first n_samples_taken rows, and discards later rows.
  virtual void resume(const std::vector<std::string>& /*columns*/, long /*n_samples_taken*/) {}
  /// All rows of the table after a call of `resume`.
  virtual io::Table rows_so_far() { return {}; }

  /// True if the sink writes a picture of this sample.
  virtual bool wants_frame(long /*sample*/) const { return false; }
  /// Writes the picture of a sample with the given function.
  virtual void draw_frame(long /*sample*/, const Draw&) {}

  /// True if the sink writes the table <name>.csv of the shapes for a report. A shape is a block of rows for one
  /// sample. The rows have positions of points on the surface and on the coordinate planes of the body.
  virtual bool has_shapes() const { return false; }
  /// True if the sink writes the shape at this sample.
  virtual bool wants_shape(long /*sample*/) const { return false; }
  /// Creates the table of shapes <name>.csv with these columns. A resumed run calls `resume_shapes` instead.
  virtual void create_shapes(const std::string& /*name*/, const std::vector<std::string>& /*columns*/) {}
  /// Continues the table of shapes after the shapes of the first n_samples_taken samples, and discards later shapes.
  virtual void resume_shapes(const std::string& /*name*/, const std::vector<std::string>& /*columns*/,
                             long /*n_samples_taken*/) {}
  /// Appends the block of rows of one shape. Requires an earlier call of `create_shapes` or `resume_shapes`.
  virtual void append_shape(const Rows&) {}

  /// Updates the display of the completed fraction of the run, from 0 to 1.
  virtual void progress(double /*part*/) {}
  /// Removes the display of the progress at the end of the run.
  virtual void progress_ends() {}
};

/// Stores the rows in a table in memory and discards all other results.
class RowsInMemory : public ModelSink {
 public:
  explicit RowsInMemory(io::Table& rows) : rows_(rows) {}
  void create(const std::vector<std::string>& columns) override { rows_ = {columns, {}}; }
  void append(const std::vector<double>& row) override {
    rows_.values.insert(rows_.values.end(), row.begin(), row.end());
  }

 private:
  io::Table& rows_;
};

}  // namespace pseudorigid::app
