#pragma once
/// One model's run, the same for all systems: choice of method and step, time loop, and output to its sink: rows,
/// pictures, checkpoints, progress.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "app/ranks/on_all_ranks.h"
#include "app/run/checkpoint_vectors.h"
#include "app/run/model_checkpoint.h"
#include "app/run/model_stepping.h"
#include "app/run/run_context.h"
#include "app/run/runnable_model.h"
#include "mechanics/methods/time_loop.h"

namespace pseudorigid::app {

template <RunnableModel Model>
class ModelRun {
  using System = typename Model::System;
  using State = mechanics::State<System>;
  using Status = mechanics::Status;
  using Clock = std::chrono::steady_clock;
  using Outcome = mechanics::Outcome;

 public:
  /// `stepping`: found by another run of the scene, in place of a search.
  ModelRun(Model& model, const RunContext& context, const std::optional<Stepping>& stepping = {})
      : model_(model),
        context_(context),
        sink_(context.sink_of(context, model.name)),
        identity_(sink_->keeps_states() ? run_identity(context.scene) : RunIdentity{}),
        times_{context.internal_time(context.scene.time.end), context.scene.output.samples},
        stepping_(model, context, stepping, times_.end, times_.interval()),
        state_(model.initial_state()),
        vectors_(model) {
    good_.state = state_;
  }

  ModelOutcome run() {
    const auto start = Clock::now();
    if (Status status = begin(); !status) {
      if (context_.interrupted()) return outcome(Outcome::interrupted, status.reason(), start);
      return outcome(Outcome::failed, stopped(state_.t, status.reason()), start);
    }
    mechanics::RunResult result;
    if (next_stepping_) result = run_until(is_adaptive() ? position_.cursor.sample + 1 : position_.stretch.last);
    if (result.outcome == Outcome::finished) {
      if (next_stepping_) step_anew();
      result = run_until(times_.n_samples);
      while (result.outcome == Outcome::failed && step_back(result)) result = run_until(times_.n_samples);
    }
    sink_->progress_ends();
    return end(std::move(result), start);
  }

  // Hooks of the time loop.

  template <class Workspace>
  Status sample(long k, const State& state, Workspace& workspace) {
    const double time = context_.time_of_sample(k);
    auto& system_workspace = workspace_of_system(workspace);
    if (Status status = model_.row(time, state, system_workspace, row_); !status) return status;
    if (!std::all_of(row_.begin(), row_.end(), [](double x) { return std::isfinite(x); }))
      return Status::failure("the motion has grown beyond the range of numbers");
    measure_constraint(state);
    sink_->append(row_);
    if constexpr (requires { model_.write_frame(std::filesystem::path(), time, state, system_workspace); })
      if (sink_->wants_frame(k))
        sink_->draw_frame(k, [&](const auto& path) { return model_.write_frame(path, time, state, system_workspace); });
    if constexpr (has_shapes)
      if (sink_->wants_shape(k)) sink_->append_shape(model_.shape(time, state));
    const bool within_steps = position_.stretch.n_steps > 0 && k < position_.stretch.last;
    position_.cursor = {k, within_steps ? position_.cursor.step : 0};
    if (!within_steps) position_.stretch = {k, k + 1, 0};
    if (k == 0 || !(within_steps || is_adaptive())) good_.take(position_, state, workspace);
    if (k == 0) save(good_);
    return {};
  }

  template <class Workspace>
  long steps_per_interval(long k, const State& state, Workspace&) {
    if (stepping_.adapts(position_) && k >= position_.looks.next) stepping_.reconsider(state, position_);
    return times_.steps_per_interval(position_.step);
  }

  template <class Workspace>
  mechanics::Stretch stretch(long k, const State& state, Workspace& workspace) {
    if (position_.stretch.n_steps > 0) return position_.stretch;
    position_.stretch = {k, k + 1, steps_per_interval(k, state, workspace)};
    if constexpr (requires { workspace.interpolation_tolerance; })
      if (workspace.interpolation_tolerance > 0) {
        const long last = end_of_long_stretch(k);
        const mechanics::SampleTimes whole{times_[last] - times_[k]};
        position_.stretch = {k, last, whole.steps_per_interval(position_.step)};
      }
    return position_.stretch;
  }

  template <class Workspace>
  bool step_done(mechanics::Cursor cursor, const State& state, Workspace& workspace) {
    position_.cursor = cursor;
    if constexpr (requires { model_.judge(state); })
      if (Status status = model_.judge(state); !status) {
        verdict_ = std::move(status);
        return false;
      }
    // Steps of an adaptive method do not end at samples.
    if (is_adaptive()) good_.take(position_, state, workspace);
    if (++steps_since_look_ < Model::steps_between_looks) return true;
    steps_since_look_ = 0;
    sink_->progress(state.t / times_.end);
    const bool interrupted = context_.interrupted();
    const bool due = context_.ranks->of_first(Clock::now() - last_save_ > seconds_between_checkpoints);
    if (interrupted || due) {
      Snapshot<System> now;
      now.take(position_, state, workspace);
      save(now);
    }
    return !interrupted;
  }

 private:
  /// Last sample of a stretch from sample k on, if steps are longer than the intervals. It has a sixteenth of the run
  /// or less, and eight steps at least. A run that fails goes back to the begin of its stretch.
  long end_of_long_stretch(long k) const {
    const double n = static_cast<double>(times_.n_samples),
                 n_stretches = std::clamp(std::floor(times_.end / position_.step / 8), 1.0, 16.0);
    double i = std::floor(static_cast<double>(k) / n * n_stretches);
    while (std::lround(n * i / n_stretches) <= k) ++i;
    return std::lround(n * i / n_stretches);
  }
  bool is_adaptive() const { return stepping_.is_adaptive(position_.method); }
  static constexpr bool has_constraints = [] {
    if constexpr (mechanics::ConstrainedSystem<System>) return !mechanics::unconstrained<System>;
    return false;
  }();
  static constexpr bool has_quadrature = requires(Model & model, const State& state) {
    model.choose_quadrature(state);
    model.estimate_quadrature(state, 0.0);
  };
  static constexpr bool has_shapes = requires(const Model& model) { model.shape_columns(); };
  static constexpr std::chrono::seconds seconds_between_checkpoints{5};

  struct NextStepping {
    mechanics::MethodId method;
    double step, local_tolerance;
    RunIdentity identity;
  };

  /// Goes on to a sample with the method of the position.
  mechanics::RunResult run_until(long sample) {
    mechanics::RunResult result{Outcome::failed, "", state_.t};
    with_fitting_method<System>(position_.method,
                                [&]<class Method>(Method) { result = run_until_with<Method>(sample); });
    return result;
  }

  template <class Method>
  mechanics::RunResult run_until_with(long sample) {
    const auto& form = mechanics::form_for<Method>(model_.system());
    typename Method::template Workspace<mechanics::FormFor<Method, System>> workspace(form);
    on_all_ranks(*context_.ranks, [&] { restore_memory(workspace); });
    workspace.counters = good_.counters;
    if constexpr (Method::adaptive) {
      workspace.tolerance = position_.local_tolerance;
      workspace.h_max = position_.step;
    }
    if constexpr (requires { workspace.most_halvings; })
      if (stepping_.adapts(position_)) {
        const double tolerance = context_.scene.time.tolerance;
        workspace.tolerance = std::min(workspace.tolerance, tolerance);
        workspace.iteration_tolerance = Method::iteration_tolerance(Model::pilot_reserve * tolerance, times_.end);
        if (position_.step > times_.interval() * (1 + 1e-12))
          workspace.interpolation_tolerance = Model::pilot_reserve * tolerance;
      }
    if constexpr (has_constraints && mechanics::has_costly_force<System> &&
                  requires { workspace.constraint_tolerance; })
      workspace.constraint_tolerance =
          std::max(workspace.constraint_tolerance, stepping_.constraint_tolerance() * model_.constraint_scale());
    const mechanics::SampleTimes times{sample == times_.n_samples ? times_.end : times_[sample], sample};
    auto result = mechanics::run_time_loop<Method>(form, times, state_, position_.cursor, workspace, *this);
    if (!verdict_) result = {Outcome::failed, verdict_.reason(), result.t};
    counters_ = workspace.counters;
    if (position_.time_error) statistics_.counters["estimated_time_error"] = *position_.time_error;
    model_.report(workspace, statistics_);
    return result;
  }

  template <class Workspace>
  typename System::Workspace& workspace_of_system(Workspace& workspace) {
    if constexpr (std::is_same_v<decltype(workspace.system), typename System::Workspace>) {
      return workspace.system;
    } else {
      if (!system_workspace_) system_workspace_.emplace(model_.system().make_workspace());
      return *system_workspace_;
    }
  }

  /// Back to the last sample with half the step, a few times in a run, if the step is the program's choice. Elements of
  /// a violent motion turn inside out the sooner the longer the steps are, with every method alike.
  bool step_back(const mechanics::RunResult& failure) {
    constexpr int most = 3;
    const bool may =
        is_distributed<Model> && verdict_ && stepping_.adapts(position_) && good_.position.cursor.sample > 0;
    if (!may || ++n_steps_back_ > most) return false;
    state_ = good_.state;
    position_ = good_.position;
    position_.step /= 2;
    position_.stretch.n_steps = 0;
    good_.position = position_;
    context_.log->info("{}: step reduced to {:.4g} at t = {}, since it fails at t = {}: {}", model_.name,
                       position_.step * context_.units.time, physical_time(state_.t), physical_time(failure.t),
                       failure.reason);
    return true;
  }

  /// Restarts the method at a sample; the history of a multistep method is discarded.
  void step_anew() {
    std::swap(position_.method, next_stepping_->method);
    std::swap(position_.step, next_stepping_->step);
    std::swap(position_.local_tolerance, next_stepping_->local_tolerance);
    position_.looks = {.next = position_.cursor.sample};
    identity_ = next_stepping_->identity;
    good_.position = position_;
    good_.state = state_;
    good_.memory.clear();
    good_.counters = counters_;
    next_stepping_.reset();
  }

  Status begin() {
    const std::vector<std::string> columns = model_.columns();
    if (const std::optional<io::Checkpoint> left = sink_->state_to_resume()) {
      if (Status status = restore(*left); !status) return status;
      const long n_samples = n_samples_taken(position_.cursor);
      sink_->resume(columns, n_samples);
      if constexpr (has_shapes)
        if (sink_->has_shapes()) sink_->resume_shapes(model_.shape_file(), model_.shape_columns(), n_samples);
      if constexpr (requires { model_.take_up(io::Table()); })
        if (n_samples > 0) model_.take_up(sink_->rows_so_far());
      context_.log->info("{}: resumed at t = {:.6g}", model_.name, state_.t * context_.units.time);
    } else {
      const Status status = choose_stepping();
      sink_->create(columns);
      if constexpr (has_shapes)
        if (sink_->has_shapes()) sink_->create_shapes(model_.shape_file(), model_.shape_columns());
      // The start, from which a run goes on that was interrupted before it had a step, or with a step that the user
      // gives if none was found.
      save(good_);
      if (!status) return status;
    }
    last_save_ = Clock::now();
    return {};
  }

  /// At the start of a run this includes the rule of quadrature.
  Status choose_stepping() {
    if constexpr (has_quadrature) model_.choose_quadrature(state_);
    Status status = stepping_.choose(state_, position_, statistics_);
    if constexpr (has_quadrature)
      if (status) model_.estimate_quadrature(state_, position_.looks.stable_step);
    return status;
  }

  template <class Workspace>
  void restore_memory(Workspace& workspace) {
    try {
      vectors_.restore_memory(workspace, good_);
    } catch (const std::invalid_argument&) {
      throw UserError("the checkpoint in " + context_.directory.path().string() + " does not fit its method");
    }
  }

  Status restore(const io::Checkpoint& file) {
    on_all_ranks(*context_.ranks, [&] {
      from_checkpoint(file, good_);
      vectors_.take(file, good_);
    });
    state_ = good_.state;
    counters_ = good_.counters;
    position_ = good_.position;
    if constexpr (requires { model_.remarks(); })
      model_.take_remarks(file.get_doubles("remarks", model_.remarks().size()));
    // To a later end the same samples may be times of another last digit.
    if (const double at = times_[position_.cursor.sample]; std::abs(state_.t - at) < 1e-12 * times_.end)
      state_.t = good_.state.t = at;
    const bool complete = position_.cursor.sample == times_.n_samples;
    const bool has_step = position_.step > 0;  // none was found at the start if that ended the run
    if (!has_step && state_.t == 0) return choose_stepping();
    if constexpr (has_quadrature)
      if (state_.t == 0) model_.estimate_quadrature(state_, position_.looks.stable_step);  // unless it is known
    if (complete || (has_step && file.get_string("stepping") == identity_.stepping)) return {};
    // A given step that makes the run's own shorter needs no search.
    const bool keeps_method =
        has_step && stepping_.shortens(position_) && file.get_string("choice") == identity_.choice;
    // New steps begin at a sample. A run that failed stands at one; one that stands within an interval finishes it with
    // the old ones first.
    const RunPosition old = position_;
    if (keeps_method)
      stepping_.shorten(position_);
    else if (Status status = stepping_.choose(state_, position_, statistics_); !status)
      return status;
    if (old.stretch.n_steps == 0 && state_.t == times_[old.cursor.sample]) {
      // With the same method the multipliers of the past are worth keeping: a violent motion does not start without.
      if (position_.method != old.method) good_.memory.clear();
      return {};
    }
    next_stepping_ = {position_.method, position_.step, position_.local_tolerance, identity_};
    identity_.stepping = file.get_string("stepping");
    identity_.choice = file.get_string("choice");
    position_ = old;
    return {};
  }

  void measure_constraint(const State& state) {
    if constexpr (has_constraints) {
      const double scale = model_.constraint_scale();
      auto residual = model_.system().make_multiplier();
      if (Status status = model_.system().constraint(state.q, residual); !status) return;
      position_.max_constraint = std::max(position_.max_constraint, mechanics::max_norm(residual) / scale);
      model_.system().constraint_rate(state.q, state.v, residual);
      position_.max_constraint_rate = std::max(position_.max_constraint_rate, mechanics::max_norm(residual) / scale);
    }
  }

  void save(Snapshot<System>& snapshot) {
    if (!sink_->keeps_states()) return;
    SavedVectors vectors = vectors_.collect(snapshot);
    sink_->save([&] {
      io::Checkpoint checkpoint = to_checkpoint(identity_, snapshot, std::move(vectors));
      if constexpr (requires { model_.remarks(); }) checkpoint.set("remarks", model_.remarks());
      return checkpoint;
    });
    last_save_ = Clock::now();
  }

  ModelOutcome end(mechanics::RunResult result, Clock::time_point start) {
    if (result.outcome == Outcome::interrupted)
      return outcome(Outcome::interrupted, "interrupted at t = " + physical_time(result.t), start);
    save(good_);
    if (result.outcome == Outcome::finished) return outcome(Outcome::finished, "", start);
    return outcome(Outcome::failed,
                   stopped(result.t, result.reason) + (sink_->keeps_states() ? "; " + saved_state() : ""), start);
  }

  std::string saved_state() const {
    std::string text = "the state at t = " + physical_time(good_.state.t) +
                       (stepping_.is_adaptive(position_.method) ? "" : ", the last sample,") + " is saved";
    if constexpr (requires { model_.place_of_least_jacobian(good_.state); })
      text += ", " + model_.place_of_least_jacobian(good_.state);
    return text;
  }

  std::string stopped(double t, const std::string& reason) const {
    return "stopped at t = " + physical_time(t) + ": " + reason;
  }

  std::string physical_time(double internal) const {
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", internal * context_.units.time);
    return text;
  }

  ModelOutcome outcome(Outcome end, const std::string& message, Clock::time_point start) {
    const mechanics::Counters& n = counters_;
    auto& c = statistics_.counters;
    c["steps"] = static_cast<double>(n.n_steps);
    c["substeps"] = static_cast<double>(n.n_substeps);
    c["forces"] = static_cast<double>(n.n_force);
    c["step"] = position_.step * context_.units.time;
    c["order"] = mechanics::with_method(position_.method, []<class Method>(Method) { return Method::order; });
    if constexpr (has_constraints) {
      c["position_iterations"] = static_cast<double>(n.n_position_iterations);
      c["velocity_projections"] = static_cast<double>(n.n_projections);
      c["max_scaled_constraint"] = position_.max_constraint;
      c["max_scaled_constraint_rate"] = position_.max_constraint_rate;
    }
    statistics_.timers["run"] = std::chrono::duration<double>(Clock::now() - start).count();
    return {end, message.empty() ? message : std::string(model_.name) + " " + message, std::move(statistics_),
            Stepping{position_.method, position_.step}};
  }

  Model& model_;
  const RunContext& context_;
  std::unique_ptr<ModelSink> sink_;
  RunIdentity identity_;
  mechanics::SampleTimes times_;
  ModelStepping<Model> stepping_;
  State state_;
  mechanics::Counters counters_;
  std::optional<typename System::Workspace> system_workspace_;  ///< for rows, where the method has none
  RunPosition position_;
  std::optional<NextStepping> next_stepping_;  ///< from the next sample on, if it changes
  int n_steps_back_ = 0;
  Status verdict_;         ///< of the model on its state, where that ends the run
  Snapshot<System> good_;  ///< at the last sample: where a failed run is taken up again
  CheckpointVectors<Model> vectors_;
  io::Manifest::Model statistics_;
  std::vector<double> row_;
  Clock::time_point last_save_{};
  int steps_since_look_ = 0;
};

}  // namespace pseudorigid::app
