#pragma once
/// The files that one model's run writes as it goes: rows, pictures and their list. Of several ranks the first writes
/// them, and each its piece of a picture.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/ranks/on_all_ranks.h"
#include "app/run/frame_schedule.h"
#include "app/run/run_context.h"
#include "io/csv.h"
#include "io/pvd.h"

namespace pseudorigid::app {

class ModelFiles {
 public:
  ModelFiles(const RunContext& context, const char* model)
      : context_(context),
        model_(model),
        frames_(context.scene.output.frames, context.scene.output.samples),
        shapes_(context.scene.output.samples) {}

  void create(const std::vector<std::string>& columns) {
    together([&] {
      if (!context_.writes()) return;
      csv_.emplace(io::CsvWriter::create(csv(), columns));
      if (context_.needs.graphics) pvd_.emplace(context_.directory.pvd(model_));
    });
  }

  /// Whether there is a checkpoint to go on from. The first rank decides: the others may look at the disk a moment
  /// later, or at another one.
  bool exists_to_resume(const std::filesystem::path& checkpoint) {
    if (context_.rows || !context_.resume) return false;
    bool exists = false;
    together([&] { exists = std::filesystem::exists(checkpoint); });
    return context_.ranks->of_first(exists);
  }

  /// Goes on after that many samples.
  void resume(const std::vector<std::string>& columns, long n_samples_taken) {
    together([&] {
      if (!context_.writes()) return;
      csv_.emplace(io::CsvWriter::resume(csv(), columns, n_samples_taken));
      if (!context_.needs.graphics) return;
      std::vector<io::PvdCollection::Frame> written;
      for (long j = 0; j < frames_.n_before(n_samples_taken); ++j)
        for (const bool of_several_ranks : {false, true})
          if (const auto path = shown(j, of_several_ranks); std::filesystem::exists(path))
            written.push_back({time_of_sample(frames_.sample(j)), path});
      pvd_.emplace(context_.directory.pvd(model_), std::move(written));
    });
  }

  /// The table of shapes that a report shows, if there is to be one: a block of rows at each of a few times.
  void create_shapes(const std::vector<std::string>& columns) {
    together([&] {
      if (context_.writes()) shapes_csv_.emplace(io::CsvWriter::create(context_.directory.csv("shapes"), columns));
    });
  }
  void resume_shapes(const std::vector<std::string>& columns, std::size_t n_rows_of_shape, long n_samples_taken) {
    together([&] {
      if (!context_.writes()) return;
      const auto n_rows = shapes_.n_before(n_samples_taken) * static_cast<std::int64_t>(n_rows_of_shape);
      shapes_csv_.emplace(io::CsvWriter::resume(context_.directory.csv("shapes"), columns, n_rows));
    });
  }
  bool has_shapes() const { return context_.needs.report && !context_.rows; }
  bool wants_shape(long sample) const { return has_shapes() && shapes_.has(sample); }
  void append_shape(const std::vector<std::vector<double>>& rows) {
    together([&] {
      if (shapes_csv_)
        for (const std::vector<double>& row : rows) shapes_csv_->append(row);
    });
  }

  void append(const std::vector<double>& row) {
    if (context_.rows) context_.rows->values.insert(context_.rows->values.end(), row.begin(), row.end());
    together([&] {
      if (csv_) csv_->append(row);
    });
  }
  void flush() {
    if (csv_) csv_->flush();
    if (shapes_csv_) shapes_csv_->flush();
  }

  bool wants_frame(long sample) const { return context_.needs.graphics && !context_.rows && frames_.has(sample); }

  /// `draw(path)` returns a Status and is collective. A picture that cannot be drawn (a node turned inside out while
  /// the quadrature points are sound) is left out: the run is the same with and without pictures.
  template <class Draw>
  void draw_frame(long sample, Draw&& draw) {
    const long j = frames_.n_before(sample);
    const double time = time_of_sample(sample);
    if (const mechanics::Status status = draw(shown(j, false)); !status)
      context_.log->warn("{}: no picture at t = {:.6g}: {}", model_, time, status.reason());
    else
      together([&] {
        if (pvd_) pvd_->add(time, shown(j, context_.ranks->size() > 1));
      });
  }

  double time_of_sample(long k) const {
    return context_.scene.time.end * (static_cast<double>(k) / static_cast<double>(context_.scene.output.samples));
  }

  /// Does what may fail for want of disk space. If it fails on one rank, it fails on all.
  template <class Work>
  void together(Work&& work) {
    on_all_ranks(*context_.ranks, work);
  }

 private:
  std::filesystem::path csv() const { return context_.directory.csv(model_); }
  /// What the list of pictures names: of several ranks the file that lists their pieces.
  std::filesystem::path shown(long j, bool of_several_ranks) const {
    auto path = context_.directory.frame(model_, static_cast<int>(j));
    return of_several_ranks ? path.replace_extension("pvtu") : path;
  }

  const RunContext& context_;
  const char* model_;
  FrameSchedule frames_;
  ShapeSchedule shapes_;
  std::optional<io::CsvWriter> csv_, shapes_csv_;
  std::optional<io::PvdCollection> pvd_;
};

}  // namespace pseudorigid::app
