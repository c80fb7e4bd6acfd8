#include "app/run/model_run.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace pseudorigid::app {

namespace {
constexpr std::chrono::seconds seconds_between_checkpoints{5};
}

ModelRunBase::ModelRunBase(RunnableModel& model, const RunContext& context, const SystemTraits& traits,
                           const std::optional<Stepping>& stepping)
    : ModelStepping(model, context, traits, stepping),
      sink_(context.sink_of(context, model.name.c_str())),
      has_shapes_(sink_->has_shapes() && !model.shape_file().empty()),
      identity_(sink_->keeps_states() ? run_identity(context.scene) : RunIdentity{}) {}

ModelOutcome ModelRunBase::run() {
  const auto start = Clock::now();
  if (Status status = begin(); !status) {
    if (context_.interrupted()) return outcome(Outcome::interrupted, status.reason(), start);
    return outcome(Outcome::failed, "stopped at t = " + physical_time(time()) + ": " + status.reason(), start);
  }
  mechanics::RunResult result;
  if (next_stepping_) result = run_until(position_.cursor.sample + 1);
  if (result.outcome == Outcome::finished) {
    if (next_stepping_) step_anew();
    result = run_until(times_.n_samples);
    while (result.outcome == Outcome::failed && step_back(result)) result = run_until(times_.n_samples);
  }
  sink_->progress_ends();
  return end(std::move(result), start);
}

mechanics::Status ModelRunBase::check_row() const {
  if (std::all_of(row_.begin(), row_.end(), [](double x) { return std::isfinite(x); })) return {};
  return Status::failure("the motion has grown beyond the range of numbers");
}

bool ModelRunBase::is_time_to_save() const {
  return context_.ranks->of_first(Clock::now() - last_save_ > seconds_between_checkpoints);
}

/// Returns to the last sample and halves the step, at most three times in a run. Returns false if this is not possible.
/// A return requires distributed vectors, a method of fixed step, a step that the program has chosen, and a sample
/// after the first. A return is not possible if the model itself ended the run. In a violent motion of finite elements,
/// a longer step inverts an element sooner, with every method.
bool ModelRunBase::step_back(const mechanics::RunResult& failure) {
  constexpr int most = 3;
  const bool may = traits_.is_distributed && verdict_ && adapts() && good_.position.cursor.sample > 0;
  if (!may || ++n_steps_back_ > most) return false;
  return_to_kept_state();
  position_ = good_.position;
  position_.step /= 2;
  position_.steps_in_interval = 0;
  good_.position = position_;
  context_.log->info("{}: step reduced to {:.4g} at t = {}, since it fails at t = {}: {}", any_model_.name,
                     position_.step * context_.units.time, physical_time(time()), physical_time(failure.t),
                     failure.reason);
  return true;
}

/// Continues from a sample with the new method and step. Discards the memory of the old method.
void ModelRunBase::step_anew() {
  std::swap(position_.method, next_stepping_->method);
  std::swap(position_.step, next_stepping_->step);
  std::swap(position_.local_tolerance, next_stepping_->local_tolerance);
  position_.looks = {.next = position_.cursor.sample};
  identity_ = next_stepping_->identity;
  good_.position = position_;
  keep_state();
  good_.memory.clear();
  good_.counters = counters_;
  next_stepping_.reset();
}

mechanics::Status ModelRunBase::begin() {
  const std::vector<std::string> columns = any_model_.columns();
  if (const std::optional<io::Checkpoint> left = sink_->state_to_resume()) {
    if (Status status = restore(*left); !status) return status;
    const long n_samples = n_samples_taken(position_.cursor);
    sink_->resume(columns, n_samples);
    if (has_shapes_) sink_->resume_shapes(any_model_.shape_file(), any_model_.shape_columns(), n_samples);
    if (n_samples > 0) any_model_.take_up(sink_->rows_so_far());
    context_.log->info("{}: resumed at t = {:.6g}", any_model_.name, time() * context_.units.time);
  } else {
    const Status status = choose_stepping();
    sink_->create(columns);
    if (has_shapes_) sink_->create_shapes(any_model_.shape_file(), any_model_.shape_columns());
    // The checkpoint at the start serves a run that is interrupted before its first step. The checkpoint is also
    // written if no step was found: the user can then set a step and resume.
    save();
    if (!status) return status;
  }
  last_save_ = Clock::now();
  return {};
}

/// Chooses the quadrature rule, method and step at the start of a run.
mechanics::Status ModelRunBase::choose_stepping() {
  choose_quadrature();
  Status status = choose();
  if (status) estimate_quadrature();
  return status;
}

mechanics::Status ModelRunBase::restore(const io::Checkpoint& file) {
  restore_state(file);
  counters_ = good_.counters;
  position_ = good_.position;
  if (const std::size_t n = any_model_.remarks().size(); n > 0) any_model_.take_remarks(file.get_doubles("remarks", n));
  // If the end of the run has changed, the time of the same sample may differ in the last digit.
  if (const double at = times_[position_.cursor.sample]; std::abs(time() - at) < 1e-12 * times_.end) set_time(at);
  const bool complete = position_.cursor.sample == times_.n_samples;
  const bool has_step = position_.step > 0;  // false if the run ended at the start because no step was found
  if (!has_step && time() == 0) return choose_stepping();
  if (time() == 0) estimate_quadrature();  // does nothing if the error is known
  if (complete || (has_step && file.get_string("stepping") == identity_.stepping)) return {};
  // If the scene now gives a shorter step for the same method, the run uses this step without a search.
  const bool keeps_method = has_step && shortens() && file.get_string("choice") == identity_.choice;
  // New steps begin at a sample. A run that has stopped within an interval first finishes the interval with the old
  // steps.
  const RunPosition old = position_;
  if (keeps_method)
    shorten();
  else if (Status status = choose(); !status)
    return status;
  if (old.steps_in_interval == 0 && time() == times_[old.cursor.sample]) {
    // If the method is the same, its memory is kept. The memory can contain past multipliers, and a violent motion
    // cannot start without them.
    if (position_.method != old.method) good_.memory.clear();
    return {};
  }
  next_stepping_ = {position_.method, position_.step, position_.local_tolerance, identity_};
  identity_.stepping = file.get_string("stepping");
  identity_.choice = file.get_string("choice");
  position_ = old;
  return {};
}

void ModelRunBase::write(const Snapshot& snapshot, SavedVectors vectors) {
  sink_->save([&] {
    io::Checkpoint checkpoint = to_checkpoint(identity_, snapshot, std::move(vectors));
    if (const std::vector<double> remarks = any_model_.remarks(); !remarks.empty()) checkpoint.set("remarks", remarks);
    return checkpoint;
  });
  last_save_ = Clock::now();
}

ModelOutcome ModelRunBase::end(mechanics::RunResult result, Clock::time_point start) {
  if (result.outcome == Outcome::interrupted)
    return outcome(Outcome::interrupted, "interrupted at t = " + physical_time(result.t), start);
  save();
  if (result.outcome == Outcome::finished) return outcome(Outcome::finished, "", start);
  return outcome(Outcome::failed,
                 "stopped at t = " + physical_time(result.t) + ": " + result.reason +
                     (sink_->keeps_states() ? "; " + saved_state() : ""),
                 start);
}

std::string ModelRunBase::saved_state() const {
  std::string text =
      "the state at t = " + physical_time(good_.t) + (is_adaptive() ? "" : ", the last sample,") + " is saved";
  if (const std::string place = place_of_least_jacobian(); !place.empty()) text += ", " + place;
  return text;
}

std::string ModelRunBase::physical_time(double internal) const {
  return fmt::format("{:.6g}", internal * context_.units.time);
}

ModelOutcome ModelRunBase::outcome(Outcome end, const std::string& message, Clock::time_point start) {
  const mechanics::Counters& n = counters_;
  auto& c = statistics_.counters;
  c["steps"] = static_cast<double>(n.n_steps);
  c["substeps"] = static_cast<double>(n.n_substeps);
  c["forces"] = static_cast<double>(n.n_force);
  c["step"] = position_.step * context_.units.time;
  mechanics::with_method(position_.method, [&]<class Method>(Method) {
    c["order"] = Method::order;
    statistics_.method = Method::name;
    statistics_.symplectic = Method::symplectic;
  });
  if (traits_.has_constraints) {
    c["position_iterations"] = static_cast<double>(n.n_position_iterations);
    c["velocity_projections"] = static_cast<double>(n.n_projections);
    c["max_scaled_constraint"] = position_.max_constraint;
    c["max_scaled_constraint_rate"] = position_.max_constraint_rate;
  }
  statistics_.timers["run"] = std::chrono::duration<double>(Clock::now() - start).count();
  return {end, message.empty() ? message : any_model_.name + " " + message, std::move(statistics_),
          Stepping{position_.method, position_.step}};
}

}  // namespace pseudorigid::app
