#pragma once
/// The sink that writes the files of one model's run: rows, pictures and their list, shapes, and checkpoints. If there
/// are several ranks, the first rank writes these files, and each rank writes its piece of a picture. If writing fails
/// on one rank, for example because the disk is full, it fails on all ranks.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/run/frame_schedule.h"
#include "app/run/model_sink.h"
#include "app/run/run_context.h"
#include "io/csv.h"
#include "io/progress.h"
#include "io/pvd.h"

namespace pseudorigid::app {

class ModelFiles : public ModelSink {
 public:
  ModelFiles(const RunContext& context, std::string model);

  void create(const std::vector<std::string>& columns) override;
  void append(const std::vector<double>& row) override;

  bool keeps_states() const override { return true; }
  void save(const std::function<io::Checkpoint()>& checkpoint) override;
  std::optional<io::Checkpoint> state_to_resume() override;
  void resume(const std::vector<std::string>& columns, long n_samples_taken) override;
  io::Table rows_so_far() override;

  bool wants_frame(long sample) const override { return context_.needs.graphics && frames_.has(sample); }
  /// Writes a picture. If the fields of the picture cannot be computed, logs a warning, and the run continues. For
  /// example, a node can have det F ≤ 0 while all quadrature points have det F > 0.
  void draw_frame(long sample, const Draw& draw) override;

  bool has_shapes() const override { return context_.needs.report; }
  bool wants_shape(long sample) const override { return has_shapes() && shapes_.has(sample); }
  void create_shapes(const std::string& name, const std::vector<std::string>& columns) override;
  void resume_shapes(const std::string& name, const std::vector<std::string>& columns, long n_samples_taken) override;
  void append_shape(const Rows& rows) override;

  void progress(double part) override { progress_.step(part); }
  void progress_ends() override { progress_.finish(); }

 private:
  bool writes() const { return context_.ranks->is_first(); }  ///< the first rank writes
  std::filesystem::path csv() const { return context_.directory.csv(model_); }
  std::filesystem::path checkpoint() const { return context_.directory.checkpoint(model_); }
  /// A time in the user's units, half an interval before sample number n_samples_taken, which is the first sample that
  /// is not yet written. Despite the round-off of times, it separates the written samples from later samples.
  double next_time(long n_samples_taken) const {
    return context_.time_of_sample(n_samples_taken) - context_.time_of_sample(1) / 2;
  }
  /// Continues the list of pictures of an earlier run, and the numbering of the pictures. Called on the first rank
  /// only.
  void resume_pictures(long n_samples_taken);

  const RunContext& context_;
  std::string model_;
  FrameSchedule frames_;
  int n_more_frames_ = 0;  ///< added to the numbers of new pictures. It is positive if an earlier run with an earlier
                           ///< end wrote more pictures than the schedule has up to this sample.
  ShapeSchedule shapes_;
  io::Progress progress_;
  std::optional<io::CsvWriter> csv_,
      shapes_csv_;  ///< tables of rows and of shapes; empty on ranks other than the first
  /// The list of pictures. It is empty without pictures, and on ranks other than the first.
  std::optional<io::PvdCollection> pvd_;
};

/// Returns a function that makes sinks for files in the directory of the run.
SinkOfModel files_of_models();

}  // namespace pseudorigid::app
