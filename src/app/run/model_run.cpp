#include "app/run/model_run.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace pseudorigid::app {

namespace {
constexpr std::chrono::seconds seconds_between_checkpoints{5};    // a killed run loses at most about this time
constexpr const char* steps_of_intervals = "steps of intervals";  // an entry of checkpoints
}  // namespace

ModelRunBase::ModelRunBase(RunnableModel& model, const RunContext& context, const SystemTraits& traits,
                           const std::optional<Stepping>& stepping)
    : ModelStepping(model, context, traits, stepping),
      sink_(context.sink_of(context, model.name.c_str())),
      has_shapes_(sink_->has_shapes() && !model.shape_file().empty()),
      identity_(sink_->keeps_states() ? run_identity(context.scene) : RunIdentity{}) {}

/// Runs the model from its start, or from its checkpoint, to the last sample. If `repeats_intervals` is true, a failed
/// interval between samples is integrated again with shorter steps.
ModelOutcome ModelRunBase::run() {
  const auto start = Clock::now();
  if (Status status = begin(); !status) {
    if (context_.interrupted()) return outcome(Outcome::interrupted, status.reason(), start);
    return outcome(Outcome::failed, "stopped at t = " + physical_time(time()) + ": " + status.reason(), start);
  }
  const auto run_to = [this](long sample) {
    mechanics::RunResult result = run_until(sample);
    while (result.outcome == Outcome::failed && repeat_interval(result)) result = run_until(sample);
    return result;
  };
  mechanics::RunResult result;
  if (next_stepping_) result = run_to(position_.cursor.sample + 1);
  if (result.outcome == Outcome::finished) {
    if (next_stepping_) step_anew();
    result = run_to(times_.n_samples);
  }
  sink_->progress_ends();
  return end(std::move(result), start);
}

/// Fails if a value of the present row is not finite.
mechanics::Status ModelRunBase::check_row() const {
  if (std::all_of(row_.begin(), row_.end(), [](double x) { return std::isfinite(x); })) return {};
  return Status::failure("the motion has grown beyond the range of numbers");
}

/// True on all ranks if the last checkpoint of the first rank is old enough for a new one. Collective.
bool ModelRunBase::is_time_to_save() const {
  return context_.ranks->of_first(Clock::now() - last_save_ > seconds_between_checkpoints);
}

/// Returns to the stored state, so that the interval can be integrated again with shorter steps. Returns false if a
/// repetition is not possible. A repetition requires a costly force, a method of fixed step and a step that the program
/// has chosen. A repetition is not possible if the model itself ended the run, or if it would need more than
/// `most_halvings` halvings of the step. The steps of later intervals depend only on the state there, on the last
/// failure, and on the last change of the energy (end_interval). A motion that is violent for a short time therefore
/// does not shorten the steps of the whole run.
bool ModelRunBase::repeat_interval(const mechanics::RunResult& failure) {
  if (!repeats_intervals() || !verdict_) return false;
  const bool asked = least_halvings_ > position_.halvings;
  const int halvings = asked ? least_halvings_ : position_.halvings + 1;
  if (halvings > most_halvings) return false;
  return_to_kept_state();
  if (!kept_remarks_.empty()) any_model_.take_remarks(kept_remarks_);  // a contact of the failed attempt does not count
  const bool energy_has_changed = position_.energy_has_changed;
  position_ = good_.position;
  position_.energy_has_changed |= energy_has_changed;
  ++position_.n_repeated;
  position_.time_error.reset();  // the pilot runs did not see the cause
  position_.n_repeated_forces += counters_.n_force - good_.counters.n_force;
  least_halvings_ = halvings;
  if (!asked) {
    ++position_.n_failed;
    position_.halvings_after_failure = halvings;
  }
  if (position_.steps_in_interval > 0) {
    // The stored state is within the interval, because the run was resumed there. The steps of this interval are
    // divided.
    const int more = halvings - position_.halvings;
    position_.steps_in_interval <<= more;
    position_.cursor.step <<= more;
    position_.halvings = halvings;
  }
  good_.position = position_;
  // There is no warning if the state at the end of the interval requires shorter steps, because this is frequent. The
  // first failed step causes a warning, because the motion before it was not resolved. Later ones are logged seldom.
  const std::string text = fmt::format(
      "{}: from t = {} the step is {:.4g} for one interval between samples, since with a longer one {}",
      any_model_.name, physical_time(time()), std::ldexp(position_.step, -halvings) * context_.units.time,
      asked ? failure.reason : fmt::format("the run fails at t = {}: {}", physical_time(failure.t), failure.reason));
  const long n_failed = asked ? 0 : position_.n_failed;
  if (n_failed == 1)
    context_.log->warn("{}", text);
  else if (n_failed == 10 || n_failed == 100 || n_failed == 1000)
    context_.log->info("{} (failure {} of this run)", text, n_failed);
  else
    context_.log->debug("{}", text);
  return true;
}

/// Continues from a sample with the new method and step. Discards the memory of the old method.
void ModelRunBase::step_anew() {
  std::swap(position_.method, next_stepping_->method);
  std::swap(position_.step, next_stepping_->step);
  std::swap(position_.local_tolerance, next_stepping_->local_tolerance);
  if (position_.time_error) position_.time_error = next_stepping_->time_error;  // else the interval was violent
  if (position_.method != next_stepping_->method) n_steps_.clear();
  position_.looks = {.next = position_.cursor.sample};
  position_.n_changes_of_energy = position_.halvings_for_energy = position_.n_held = 0;
  identity_ = next_stepping_->identity;
  good_.position = position_;
  keep_state();
  good_.memory.clear();
  good_.counters = counters_;
  next_stepping_.reset();
}

/// Starts the run, or continues it from the checkpoint that the sink gives. Fails if the choice of method and step
/// fails.
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
    // The checkpoint at the start is for a run that is interrupted before its first step. The checkpoint is also
    // written if no step was found: the user can then set a step and resume.
    save();
    if (!status) return status;
  }
  last_save_ = Clock::now();
  return {};
}

/// Chooses the quadrature rule, the method and the step at the start of a run. Fails if the choice of method and step
/// fails.
mechanics::Status ModelRunBase::choose_stepping() {
  choose_quadrature();
  Status status = choose();
  if (status) estimate_quadrature();
  return status;
}

/// Restores the run from a checkpoint. If the scene now requires another method or step, chooses them again, and fails
/// if the choice fails.
mechanics::Status ModelRunBase::restore(const io::Checkpoint& file) {
  restore_state(file);
  counters_ = good_.counters;
  position_ = good_.position;
  if (const std::size_t n = any_model_.remarks().size(); n > 0) any_model_.take_remarks(file.get_doubles("remarks", n));
  if (file.has(steps_of_intervals)) {
    const auto& numbers = file.get_doubles(steps_of_intervals);
    n_steps_.assign(numbers.begin(), numbers.end());
  }
  kept_remarks_ = any_model_.remarks();
  if (const std::string name = std::string(at_last_sample) + "remarks"; file.has(name))
    kept_remarks_ = file.get_doubles(name, kept_remarks_.size());
  // If the end of the run has changed, the time of the same sample may differ in the last digit.
  if (const double at = times_[position_.cursor.sample]; std::abs(time() - at) < 1e-12 * times_.end) set_time(at);
  const bool complete = position_.cursor.sample == times_.n_samples;
  const bool has_step = position_.step > 0;  // false if the run ended at the start because no step was found
  if (!has_step && time() == 0) return choose_stepping();
  if (time() == 0) estimate_quadrature();  // does nothing if the error is known
  if (complete || (has_step && file.get_string("stepping") == identity_.stepping)) return {};
  // If the scene now gives a step that is not longer, for the same method, the run uses this step without a search.
  const bool keeps_method = has_step && shortens() && file.get_string("choice") == identity_.choice;
  // New steps begin at a sample. A run that has stopped within an interval first finishes the interval with the old
  // steps.
  const RunPosition old = position_;
  if (keeps_method)
    shorten();
  else if (Status status = choose(); !status)
    return status;
  if (old.steps_in_interval == 0 && time() == times_[old.cursor.sample]) {
    // If the method is the same, the run continues to use its memory. The memory can contain past multipliers, and a
    // violent motion cannot start without them.
    if (position_.method != old.method) {
      good_.memory.clear();
      n_steps_.clear();
    }
    return {};
  }
  next_stepping_ = {position_.method, position_.step, position_.local_tolerance, position_.time_error, identity_};
  identity_.stepping = file.get_string("stepping");
  identity_.choice = file.get_string("choice");
  position_ = old;
  return {};
}

void ModelRunBase::write(const Snapshot& snapshot, SavedVectors vectors, std::optional<SavedVectors> of_sample) {
  sink_->save([&] {
    io::Checkpoint checkpoint = to_checkpoint(identity_, snapshot, std::move(vectors));
    if (records_steps()) checkpoint.set(steps_of_intervals, std::vector<double>(n_steps_.begin(), n_steps_.end()));
    if (of_sample) add_snapshot(checkpoint, good_, std::move(*of_sample), at_last_sample);
    if (const std::vector<double> remarks = any_model_.remarks(); !remarks.empty()) {
      checkpoint.set("remarks", remarks);
      if (of_sample) checkpoint.set(std::string(at_last_sample) + "remarks", kept_remarks_);
    }
    return checkpoint;
  });
  last_save_ = Clock::now();
}

/// Saves the stored state, and makes the outcome of the run. An interrupted run has saved its present state already.
ModelOutcome ModelRunBase::end(mechanics::RunResult result, Clock::time_point start) {
  if (result.outcome == Outcome::interrupted)
    return outcome(Outcome::interrupted, "interrupted at t = " + physical_time(result.t), start);
  // After a failure the stored state is saved, without the remarks of the failed attempt.
  if (result.outcome == Outcome::failed && repeats_intervals() && !kept_remarks_.empty())
    any_model_.take_remarks(kept_remarks_);
  save();
  if (result.outcome == Outcome::finished) return outcome(Outcome::finished, "", start);
  return outcome(Outcome::failed,
                 "stopped at t = " + physical_time(result.t) + ": " + result.reason +
                     (sink_->keeps_states() ? "; " + saved_state() : ""),
                 start);
}

/// A clause about the saved state and the place of the least det F, for the message of a failed run.
std::string ModelRunBase::saved_state() const {
  std::string text =
      "the state at t = " + physical_time(good_.t) + (is_adaptive() ? "" : ", the last sample,") + " is saved";
  if (const std::string place = place_of_least_jacobian(); !place.empty()) text += ", " + place;
  return text;
}

/// A time in the user's units, for messages.
std::string ModelRunBase::physical_time(double internal) const {
  return fmt::format("{:.6g}", internal * context_.units.time);
}

/// The outcome of the run, with its counters, its method and its step.
ModelOutcome ModelRunBase::outcome(Outcome end, const std::string& message, Clock::time_point start) {
  const mechanics::Counters& n = counters_;
  auto& c = statistics_.counters;
  c["steps"] = static_cast<double>(n.n_steps);
  c["substeps"] = static_cast<double>(n.n_substeps);
  c["forces"] = static_cast<double>(n.n_force);
  c["step"] = position_.step * context_.units.time;
  if (!position_.time_error) c.erase("estimated_time_error");
  if (repeats_intervals()) {
    c["repeated_intervals"] = static_cast<double>(position_.n_repeated);
    c["failed_intervals"] = static_cast<double>(position_.n_failed);
    c["repeated_forces"] = static_cast<double>(position_.n_repeated_forces);
    c["stable_steps"] = position_.n_stable_steps;
  }
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
  ModelOutcome outcome{end, message.empty() ? message : any_model_.name + " " + message, std::move(statistics_),
                       Stepping{position_.method, position_.step, position_.local_tolerance}, n_steps_};
  outcome.is_over = !verdict_;
  return outcome;
}

}  // namespace pseudorigid::app
