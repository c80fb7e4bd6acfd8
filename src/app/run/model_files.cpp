#include "app/run/model_files.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "app/ranks/on_all_ranks.h"
#include "app/run/resumed_checkpoint.h"

namespace pseudorigid::app {

ModelFiles::ModelFiles(const RunContext& context, std::string model)
    : context_(context),
      model_(std::move(model)),
      frames_(context.scene.output.frames, context.scene.output.samples),
      shapes_(context.scene.output.samples),
      progress_(model_, context.shows_progress) {}

void ModelFiles::create(const std::vector<std::string>& columns) {
  on_all_ranks(*context_.ranks, [&] {
    if (!writes()) return;
    csv_.emplace(io::CsvWriter::create(csv(), columns));
    if (context_.needs.graphics) pvd_.emplace(context_.directory.pvd(model_));
  });
}

void ModelFiles::append(const std::vector<double>& row) {
  on_all_ranks(*context_.ranks, [&] {
    if (csv_) csv_->append(row);
  });
}

void ModelFiles::save(const std::function<io::Checkpoint()>& checkpoint) {
  on_all_ranks(*context_.ranks, [&] {
    if (!writes()) return;
    if (csv_) csv_->flush();
    if (shapes_csv_) shapes_csv_->flush();
    checkpoint().save(this->checkpoint());
  });
}

std::optional<io::Checkpoint> ModelFiles::state_to_resume() { return resumed_checkpoint(context_, model_); }

void ModelFiles::resume(const std::vector<std::string>& columns, long n_samples_taken) {
  on_all_ranks(*context_.ranks, [&] {
    if (!writes()) return;
    csv_.emplace(io::CsvWriter::resume(csv(), columns, n_samples_taken));
    if (context_.needs.graphics) resume_pictures(n_samples_taken);
  });
  n_more_frames_ = context_.ranks->number_of(0, n_more_frames_);
}

void ModelFiles::resume_pictures(long n_samples_taken) {
  pvd_.emplace(io::PvdCollection::resume(context_.directory.pvd(model_), next_time(n_samples_taken)));
  if (pvd_->frames().empty()) return;
  const long number = pvd_->frames().back().number();
  n_more_frames_ = static_cast<int>(std::max(0L, number + 1 - frames_.n_before(n_samples_taken)));
}

io::Table ModelFiles::rows_so_far() {
  io::Table rows;
  on_all_ranks(*context_.ranks, [&] { rows = io::read_csv(csv()); });
  return rows;
}

void ModelFiles::draw_frame(long sample, const Draw& draw) {
  const auto file = context_.directory.frame(model_, static_cast<int>(frames_.n_before(sample) + n_more_frames_));
  const double time = context_.time_of_sample(sample);
  if (const mechanics::Status status = draw(file); !status)
    context_.log->warn("{}: no picture at t = {:.6g}: {}", model_, time, status.reason());
  else
    on_all_ranks(*context_.ranks, [&] {
      // If there are several ranks, the collection has the path of the .pvtu file, which lists the pieces of all ranks.
      if (pvd_)
        pvd_->add(time, context_.ranks->size() > 1 ? std::filesystem::path(file).replace_extension("pvtu") : file);
    });
}

void ModelFiles::create_shapes(const std::string& name, const std::vector<std::string>& columns) {
  on_all_ranks(*context_.ranks, [&] {
    if (writes()) shapes_csv_.emplace(io::CsvWriter::create(context_.directory.csv(name), columns));
  });
}

void ModelFiles::resume_shapes(const std::string& name, const std::vector<std::string>& columns, long n_samples_taken) {
  on_all_ranks(*context_.ranks, [&] {
    if (!writes()) return;
    // Retains the shapes before the next sample. If the earlier run had an earlier end, the times of its shapes differ
    // from the present schedule (ShapeSchedule). The first row, at the start, always remains.
    const auto path = context_.directory.csv(name);
    const std::int64_t least = n_samples_taken > 0 ? 1 : 0;
    shapes_csv_.emplace(
        io::CsvWriter::resume(path, columns, std::max(io::n_rows_before(path, next_time(n_samples_taken)), least)));
  });
}

void ModelFiles::append_shape(const Rows& rows) {
  on_all_ranks(*context_.ranks, [&] {
    if (shapes_csv_)
      for (const std::vector<double>& row : rows) shapes_csv_->append(row);
  });
}

SinkOfModel files_of_models() {
  return [](const RunContext& context, const char* model) -> std::unique_ptr<ModelSink> {
    return std::make_unique<ModelFiles>(context, model);
  };
}

}  // namespace pseudorigid::app
