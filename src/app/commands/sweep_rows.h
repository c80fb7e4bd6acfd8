#pragma once
/// sweep.csv while several threads bring rows: written in the order of the runs, with a checkpoint now and then.

#include <chrono>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "app/run/model_checkpoint.h"
#include "app/run/run_context.h"
#include "io/checkpoint.h"
#include "io/csv.h"
#include "io/progress.h"

namespace pseudorigid::app {

class SweepRows {
 public:
  static constexpr const char* name = "sweep";

  SweepRows(const RunContext& context, const std::vector<std::string>& columns, int n_runs, bool shows_progress)
      : identity_(run_identity(context.scene)),
        checkpoint_path_(context.directory.checkpoint(name)),
        n_runs_(n_runs),
        progress_(name, shows_progress, "runs") {
    const auto path = context.directory.csv(name);
    if (context.resumes) n_written_ = static_cast<int>(io::Checkpoint::load(checkpoint_path_).get_integer("rows"));
    csv_.emplace(context.resumes ? io::CsvWriter::resume(path, columns, n_written_)
                                 : io::CsvWriter::create(path, columns));
    save();
  }

  int n_written() const { return n_written_; }

  void deliver(int run, std::vector<double> row) {
    const std::lock_guard lock(mutex_);
    waiting_.emplace(run, std::move(row));
    for (auto first = waiting_.begin(); first != waiting_.end() && first->first == n_written_;
         first = waiting_.erase(first), ++n_written_)
      csv_->append(first->second);
    progress_.step(static_cast<double>(n_written_) / n_runs_);
    if (Clock::now() - last_save_ > std::chrono::seconds(5)) save();
  }

  void finish() {
    progress_.finish();
    save();
  }

 private:
  using Clock = std::chrono::steady_clock;

  void save() {
    csv_->flush();
    io::Checkpoint checkpoint;
    checkpoint.set("scene", identity_.frozen_scene);
    checkpoint.set("rows", n_written_);
    checkpoint.save(checkpoint_path_);
    last_save_ = Clock::now();
  }

  RunIdentity identity_;
  std::filesystem::path checkpoint_path_;
  int n_runs_, n_written_ = 0;
  io::Progress progress_;
  std::optional<io::CsvWriter> csv_;
  std::map<int, std::vector<double>> waiting_;  ///< rows whose predecessors are still at work
  std::mutex mutex_;
  Clock::time_point last_save_{};
};

}  // namespace pseudorigid::app
