#pragma once
/// Output of sweep.csv, and of trajectories.csv if Sweep/Trajectories is true. Several threads add rows in any order.
/// The rows are written in the order of the runs, with a checkpoint every few seconds.

#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "app/commands/kept_trajectories.h"
#include "app/commands/sweep_task.h"
#include "app/run/model_checkpoint.h"
#include "app/run/run_context.h"
#include "io/checkpoint.h"
#include "io/csv.h"
#include "io/progress.h"

namespace pseudorigid::app {

/// The open tables of a sweep and their checkpoint.
class SweepRows {
 public:
  static constexpr const char* name = "sweep";  ///< name of the table and of the checkpoint, without extension

  /// Creates the tables for the runs first_run, …, first_run + n_runs − 1, or continues the tables if the sweep is
  /// resumed. In this class the numbers of the runs count from 0. Throws UserError if the checkpoint or a table of the
  /// earlier run is missing or damaged.
  SweepRows(const RunContext& context, const std::vector<std::string>& columns, int first_run, int n_runs)
      : identity_(run_identity(context.scene)),
        checkpoint_path_(context.directory.checkpoint(name)),
        first_run_(first_run),
        n_runs_(n_runs),
        progress_(name, context.shows_progress, "runs") {
    const auto path = context.directory.csv(name);
    std::int64_t n_samples = 0;
    if (context.resumes) {
      const io::Checkpoint checkpoint = io::Checkpoint::load(checkpoint_path_);
      n_written_ = static_cast<int>(checkpoint.get_integer("rows"));
      if (context.scene.sweep_trajectories) n_samples = checkpoint.get_integer("samples");
    }
    if (context.resumes) require_sound_tables(context, columns, n_samples);
    csv_.emplace(context.resumes ? io::CsvWriter::resume(path, columns, n_written_)
                                 : io::CsvWriter::create(path, columns));
    if (context.scene.sweep_trajectories) open_samples(context, n_samples);
    save();
  }

  /// Number of rows in sweep.csv, including those of the earlier run of a resumed sweep.
  int n_written() const { return n_written_; }
  /// The first run whose row is not yet written.
  int next_run() const { return first_run_ + n_written_; }

  /// Stores the row and the samples of a run, and writes each stored row when all earlier rows are written. Several
  /// threads may call this function at the same time.
  void deliver(int run, FinishedRun finished) {
    const std::lock_guard lock(mutex_);
    waiting_.emplace(run, std::move(finished));
    for (auto first = waiting_.begin(); first != waiting_.end() && first->first == next_run();
         first = waiting_.erase(first), ++n_written_) {
      csv_->append(first->second.row);
      if (samples_) append_samples(run_number(first->first), first->second.samples);
    }
    progress_.step(static_cast<double>(n_written_) / n_runs_);
    if (Clock::now() - last_save_ > std::chrono::seconds(5)) save();
  }

  /// Ends the progress display and saves the checkpoint. Must be called after all threads have ended.
  void finish() {
    progress_.finish();
    save();
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// The number of a run in the files, which count from 1.
  static double run_number(int run) { return run + 1.0; }

  /// The names of the columns of trajectories.csv.
  static std::vector<std::string> columns_of_samples(const RunContext& context) {
    std::vector<std::string> names{"run"};
    for (std::string& name : columns_of_run(context.scene, context.needs)) names.push_back(std::move(name));
    return names;
  }

  /// Checks both tables before either of them is truncated. Throws UserError if a table is damaged.
  void require_sound_tables(const RunContext& context, const std::vector<std::string>& columns,
                            std::int64_t n_samples) const {
    io::require_rows(context.directory.csv(name), columns, n_written_);
    if (context.scene.sweep_trajectories)
      io::require_rows(context.directory.csv(trajectories_name), columns_of_samples(context), n_samples);
  }

  /// Creates trajectories.csv, or continues it after its first n_rows rows if the sweep is resumed.
  void open_samples(const RunContext& context, std::int64_t n_rows) {
    const std::vector<std::string> names = columns_of_samples(context);
    const auto path = context.directory.csv(trajectories_name);
    samples_.emplace(context.resumes ? io::CsvWriter::resume(path, names, n_rows) : io::CsvWriter::create(path, names));
  }

  /// Appends the samples of a run to trajectories.csv, each row with the number of the run.
  void append_samples(double run, const io::Table& samples) {
    std::vector<double> row;
    for (std::size_t i = 0; i < samples.n_rows(); ++i) {
      const auto values = samples.row(i);
      row.assign(1, run);
      row.insert(row.end(), values.begin(), values.end());
      samples_->append(row);
    }
  }

  /// Writes the rows to the disk, and then a checkpoint with their number. In this order, the checkpoint never counts a
  /// row that the file lacks.
  void save() {
    csv_->flush();
    io::Checkpoint checkpoint;
    checkpoint.set("scene", identity_.frozen_scene);
    checkpoint.set("rows", n_written_);
    if (samples_) {
      samples_->flush();
      checkpoint.set("samples", samples_->n_rows());
    }
    checkpoint.save(checkpoint_path_);
    last_save_ = Clock::now();
  }

  RunIdentity identity_;
  std::filesystem::path checkpoint_path_;
  int first_run_, n_runs_, n_written_ = 0;
  io::Progress progress_;
  std::optional<io::CsvWriter> csv_, samples_;
  std::map<int, FinishedRun>
      waiting_;  ///< runs whose rows wait for the rows of earlier runs; the key is the run number, from 0
  std::mutex mutex_;
  Clock::time_point last_save_{};
};

}  // namespace pseudorigid::app
