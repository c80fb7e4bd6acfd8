#pragma once
/// One model's run, the same for both: choice of method and step, time loop, CSV rows, pictures, checkpoints, progress.
///
/// A Model offers
///   using System;  static constexpr const char* name;  static constexpr int steps_between_looks;
///   static constexpr double pilot_reserve;
///   const System& system() const;  State<System> initial_state() const;  double constraint_scale() const;
///   Eigen::Matrix3d Q(state) const, Qdot(state) const;  double pilot_window(end) const;
///   std::vector<std::string> columns(quantities) const;
///   Status row(time, state, workspace, row) const;  Status write_frame(path, state, workspace);
///   void report(workspace, statistics) const.

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/frame_schedule.h"
#include "app/model_checkpoint.h"
#include "app/run_context.h"
#include "app/scene_to_model.h"
#include "io/csv.h"
#include "io/progress.h"
#include "io/pvd.h"
#include "io/signals.h"
#include "mechanics/largest_frequency.h"
#include "mechanics/step_size.h"
#include "mechanics/time_loop.h"

namespace pseudorigid::app {

template <class Model>
class ModelRun {
  using System = typename Model::System;
  using State = mechanics::State<System>;
  using Workspace = mechanics::RattleWorkspace<System>;
  using Status = mechanics::Status;
  using Clock = std::chrono::steady_clock;

 public:
  ModelRun(Model& model, const RunContext& context)
      : model_(model),
        context_(context),
        identity_(run_identity(context.scene)),
        checkpoint_path_(context.directory.checkpoint(Model::name)),
        times_{context.internal_time(context.scene.time.end), context.scene.output.samples},
        frames_(context.scene.output.frames, context.scene.output.samples),
        state_(model.initial_state()),
        workspace_(model.system()),
        progress_(Model::name, context.show_progress) {
    good_.take(position_, state_, workspace_);
  }

  ModelOutcome run() {
    const auto start = Clock::now();
    if (Status status = begin(); !status)
      return outcome(io::interrupt_requested() ? ModelOutcome::State::interrupted : ModelOutcome::State::failed,
                     status.reason(), start);
    mechanics::RunResult result;
    if (next_stepping_) result = run_until(position_.cursor.sample + 1);
    if (result.outcome == mechanics::Outcome::finished) {
      if (next_stepping_) step_anew();
      result = run_until(times_.n_samples);
    }
    progress_.finish();
    return end(std::move(result), start);
  }

  // Hooks of the time loop.

  Status sample(long k, const State& state, Workspace& workspace) {
    const double time = context_.scene.time.end * (static_cast<double>(k) / static_cast<double>(times_.n_samples));
    if (Status status = model_.row(time, state, workspace, row_); !status) return status;
    measure_constraint(state);
    csv_->append(row_);
    if (context_.needs.graphics && frames_.has(k)) write_frame(k, time, state, workspace);
    position_.cursor = {k, 0};
    position_.steps_in_interval = 0;
    good_.take(position_, state, workspace);
    if (k == 0) save(good_);
    return {};
  }

  long steps_per_interval(long k, const State& state, Workspace& workspace) {
    if (position_.steps_in_interval > 0) return position_.steps_in_interval;
    if (adapts() && k > 0 && k % looks_at_frequency_every() == 0) reconsider_step(state, workspace);
    return position_.steps_in_interval = times_.steps_per_interval(position_.step);
  }

  bool step_done(mechanics::Cursor cursor, const State& state, Workspace& workspace) {
    if (++steps_since_look_ < Model::steps_between_looks) return true;
    steps_since_look_ = 0;
    const double part = static_cast<double>(cursor.step) / static_cast<double>(position_.steps_in_interval);
    progress_.step((static_cast<double>(cursor.sample) + part) / static_cast<double>(times_.n_samples));
    const bool interrupted = io::interrupt_requested();
    if (interrupted || Clock::now() - last_save_ > seconds_between_checkpoints) {
      position_.cursor = cursor;
      Snapshot<System> now;
      now.take(position_, state, workspace);
      save(now);
    }
    return !interrupted;
  }

 private:
  static constexpr std::chrono::seconds seconds_between_checkpoints{5};
  static constexpr int n_lanczos = 24;

  struct Stepping {
    mechanics::MethodId method;
    double step;
    std::string entries;  ///< of the scene, as in RunIdentity
  };

  /// Goes on to a sample with the method of the position.
  mechanics::RunResult run_until(long sample) {
    const mechanics::SampleTimes times{sample == times_.n_samples ? times_.end : times_[sample], sample};
    return mechanics::with_method(position_.method, [&]<class Method>(Method) {
      return mechanics::run_time_loop<Method>(model_.system(), times, state_, position_.cursor, workspace_, *this);
    });
  }

  /// At a sample, with the state of which `good_` is the snapshot.
  void step_anew() {
    std::swap(position_.method, next_stepping_->method);
    std::swap(position_.step, next_stepping_->step);
    std::swap(identity_.stepping, next_stepping_->entries);
    good_.position = position_;
    next_stepping_.reset();
  }

  bool adapts() const { return !context_.scene.time.step; }
  /// The largest frequency changes with the deformation; it is looked at this often.
  long looks_at_frequency_every() const { return std::max(1L, times_.n_samples / 16); }

  Status begin() {
    const std::vector<std::string> columns = model_.columns(context_.needs.quantities);
    const auto csv_path = context_.directory.csv(Model::name);
    if (context_.resume && std::filesystem::exists(checkpoint_path_)) {
      if (Status status = restore(); !status) return status;
      // A run that stands at the very start takes sample 0 again.
      const mechanics::Cursor& at = position_.cursor;
      const long n_samples_taken = at.sample == 0 && at.step == 0 ? 0 : at.sample + 1;
      csv_.emplace(io::CsvWriter::resume(csv_path, columns, n_samples_taken));
      std::vector<io::PvdCollection::Frame> written;
      for (long j = 0; context_.needs.graphics && j < frames_.n_before(n_samples_taken); ++j)
        if (const auto path = context_.directory.frame(Model::name, static_cast<int>(j)); std::filesystem::exists(path))
          written.push_back({frame_time(j), path});
      if (context_.needs.graphics) pvd_.emplace(context_.directory.pvd(Model::name), std::move(written));
      context_.log->info("{}: resumed at t = {:.6g}", Model::name, state_.t * context_.units.time);
    } else {
      if (Status status = choose_step(); !status) return status;
      csv_.emplace(io::CsvWriter::create(csv_path, columns));
      if (context_.needs.graphics) pvd_.emplace(context_.directory.pvd(Model::name));
    }
    last_save_ = Clock::now();
    return {};
  }

  Status restore() {
    const io::Checkpoint file = io::Checkpoint::load(checkpoint_path_);
    from_checkpoint(file, good_);
    good_.put(state_, workspace_);
    position_ = good_.position;
    const bool complete = position_.cursor.sample == times_.n_samples;
    if (complete || file.get_string("stepping") == identity_.stepping) return {};
    // New steps begin at a sample. A run that failed stands at one; one that was interrupted within an interval
    // finishes it with the old ones first.
    const RunPosition old = position_;
    if (Status status = choose_step(); !status) return status;
    if (old.steps_in_interval == 0) return {};
    next_stepping_ = {position_.method, position_.step, std::exchange(identity_.stepping, file.get_string("stepping"))};
    position_ = old;
    return {};
  }

  /// Method and step of the scene, or those that its tolerance asks for. A choice made by somebody is announced.
  Status choose_step() {
    const scene::Scene& scene = context_.scene;
    const std::optional<mechanics::MethodId> method = method_of(scene);
    const double bound = scene.time.step ? context_.internal_time(*scene.time.step) : HUGE_VAL;
    if (method && scene.time.step) {
      position_.method = *method;
      position_.step = bound;
      return {};
    }
    const auto frequency = mechanics::largest_frequency(model_.system(), state_, workspace_.system, n_lanczos);
    if (!frequency.status) return frequency.status;
    const double limit = mechanics::rattle_step_limit(frequency.omega, model_.Q(state_), model_.Qdot(state_));
    const double left = times_.end - state_.t;
    mechanics::StepRequest request{.end = left,
                                   .window = model_.pilot_window(left),
                                   .tolerance = Model::pilot_reserve * scene.time.tolerance,
                                   .rattle_limit = std::min(limit, left),
                                   .step_bound = std::min(bound, times_.interval()),
                                   .method = method,
                                   .give_up = io::interrupt_requested};
    State from_zero = state_;
    from_zero.t = 0;
    auto choice =
        mechanics::choose_step(model_.system(), from_zero, request, [&](const State& s) { return model_.Q(s); });
    // Nothing is begun with a step that an interrupted search has not found.
    if (io::interrupt_requested()) return Status::failure("interrupted while looking for the step");
    if (!choice.status) {
      // The motion itself may break off within the pilot's window; the run shall get as far as it can and say where.
      position_.method = method.value_or(mechanics::MethodId::rattle);
      position_.step = mechanics::with_method(position_.method, [&]<class Method>(Method) {
        return std::min(bound, 0.5 * limit * Method::stability_limit / mechanics::Rattle::stability_limit);
      });
      context_.log->warn("{}: the step cannot be fitted to the tolerance ({}); {} with half the stable step, {:.4g}",
                         Model::name, choice.status.reason(), mechanics::method_name(position_.method),
                         position_.step * context_.units.time);
      return {};
    }
    position_.method = choice.method;
    position_.step = choice.step;
    statistics_.counters["pilot_forces"] += static_cast<double>(choice.n_force);
    statistics_.counters["estimated_time_error"] = choice.error;
    statistics_.counters["largest_frequency"] = frequency.omega / context_.units.time;
    context_.log->info("{}: {}, step {:.4g} (estimated time error {:.1e})", Model::name,
                       mechanics::method_name(choice.method), choice.step * context_.units.time, choice.error);
    context_.log->debug("{}: {}", Model::name, choice.why);
    return {};
  }

  /// Halves the step, once or more, where the motion has raised the largest frequency beyond what the step stands.
  void reconsider_step(const State& state, Workspace& workspace) {
    const auto frequency = mechanics::largest_frequency(model_.system(), state, workspace.system, n_lanczos);
    if (!frequency.status) return;  // the step itself will meet the failure and report it
    const double rattle_limit = mechanics::rattle_step_limit(frequency.omega, model_.Q(state), model_.Qdot(state), 0.9);
    const double limit = mechanics::with_method(position_.method, [&]<class Method>(Method) {
      return rattle_limit * Method::stability_limit / mechanics::Rattle::stability_limit;
    });
    const double before = position_.step;
    while (position_.step > limit) position_.step /= 2;
    if (position_.step != before)
      context_.log->info("{}: step reduced to {:.4g} at t = {:.6g}, the stiffness has grown", Model::name,
                         position_.step * context_.units.time, state.t * context_.units.time);
  }

  void measure_constraint(const State& state) {
    if constexpr (!mechanics::unconstrained<System>) {
      const double scale = model_.constraint_scale();
      if (Status status = model_.system().constraint(state.q, workspace_.residual); !status) return;
      position_.max_constraint = std::max(position_.max_constraint, mechanics::max_norm(workspace_.residual) / scale);
      model_.system().constraint_rate(state.q, state.v, workspace_.residual);
      position_.max_constraint_rate =
          std::max(position_.max_constraint_rate, mechanics::max_norm(workspace_.residual) / scale);
    }
  }

  double frame_time(long j) const {
    return context_.scene.time.end * (static_cast<double>(frames_.sample(j)) / static_cast<double>(times_.n_samples));
  }

  /// A picture that cannot be drawn (a node turned inside out while the quadrature points are sound) is left out: the
  /// run is the same with and without pictures.
  void write_frame(long k, double time, const State& state, Workspace& workspace) {
    const auto path = context_.directory.frame(Model::name, static_cast<int>(frames_.n_before(k)));
    if (Status status = model_.write_frame(path, state, workspace); !status)
      context_.log->warn("{}: no picture at t = {:.6g}: {}", Model::name, time, status.reason());
    else
      pvd_->add(time, path);
  }

  void save(Snapshot<System>& snapshot) {
    csv_->flush();
    to_checkpoint(identity_, snapshot).save(checkpoint_path_);
    last_save_ = Clock::now();
  }

  ModelOutcome end(mechanics::RunResult result, Clock::time_point start) {
    using Outcome = mechanics::Outcome;
    if (result.outcome == Outcome::interrupted)
      return outcome(ModelOutcome::State::interrupted, "interrupted at t = " + physical_time(result.t), start);
    save(good_);
    if (result.outcome == Outcome::finished) return outcome(ModelOutcome::State::finished, "", start);
    return outcome(ModelOutcome::State::failed,
                   "stopped at t = " + physical_time(result.t) + ": " + result.reason +
                       "; the state at t = " + physical_time(good_.state.t) + " is saved",
                   start);
  }

  std::string physical_time(double internal) const {
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", internal * context_.units.time);
    return text;
  }

  ModelOutcome outcome(ModelOutcome::State state, const std::string& message, Clock::time_point start) {
    const mechanics::Counters& n = workspace_.counters;
    auto& c = statistics_.counters;
    c["steps"] = static_cast<double>(n.n_steps);
    c["substeps"] = static_cast<double>(n.n_substeps);
    c["forces"] = static_cast<double>(n.n_force);
    c["step"] = position_.step * context_.units.time;
    c["order"] = mechanics::with_method(position_.method, []<class Method>(Method) { return Method::order; });
    if constexpr (!mechanics::unconstrained<System>) {
      c["position_iterations"] = static_cast<double>(n.n_position_iterations);
      c["velocity_projections"] = static_cast<double>(n.n_projections);
      c["max_scaled_constraint"] = position_.max_constraint;
      c["max_scaled_constraint_rate"] = position_.max_constraint_rate;
    }
    model_.report(workspace_, statistics_);
    statistics_.timers["run"] = std::chrono::duration<double>(Clock::now() - start).count();
    return {state, message.empty() ? message : std::string(Model::name) + " " + message, std::move(statistics_)};
  }

  Model& model_;
  const RunContext& context_;
  RunIdentity identity_;
  std::filesystem::path checkpoint_path_;
  mechanics::SampleTimes times_;
  FrameSchedule frames_;
  State state_;
  Workspace workspace_;
  RunPosition position_;
  std::optional<Stepping> next_stepping_;  ///< from the next sample on, if it changes
  Snapshot<System> good_;                  ///< at the last sample: where a failed run is taken up again
  std::optional<io::CsvWriter> csv_;
  std::optional<io::PvdCollection> pvd_;
  io::Progress progress_;
  io::Manifest::Model statistics_;
  std::vector<double> row_;
  Clock::time_point last_save_{};
  int steps_since_look_ = 0;
};

}  // namespace pseudorigid::app
