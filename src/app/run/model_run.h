#pragma once
/// The run of one model. The run chooses the method and the step, integrates the motion, and passes its results to a
/// sink. ModelRunBase does not depend on the type of the system.

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "app/ranks/on_all_ranks.h"
#include "app/run/checkpoint_vectors.h"
#include "app/run/energy_watch.h"
#include "app/run/model_checkpoint.h"
#include "app/run/model_stepping.h"
#include "app/run/run_context.h"
#include "app/run/runnable_model.h"
#include "app/run/step_limits.h"
#include "mechanics/methods/time_loop.h"
#include "mechanics/steps/step_size.h"
#include "scene/user_error.h"

namespace pseudorigid::app {

class ModelRunBase : protected ModelStepping {
 public:
  ModelOutcome run();  ///< runs the model from its start, or from its checkpoint, to the last sample; collective

 protected:
  using Clock = std::chrono::steady_clock;
  using Outcome = mechanics::Outcome;

  ModelRunBase(RunnableModel& model, const RunContext& context, const SystemTraits& traits,
               const std::optional<Stepping>& stepping);

  /// Integrates to the sample with this number, with the method and step of `position_`.
  virtual mechanics::RunResult run_until(long sample) = 0;
  // The stored state is the state at the last sample, or after the last step of an adaptive method. After a resumption,
  // it is first the state of the checkpoint. `keep_state` stores the present state; `return_to_kept_state` restores it.
  virtual void keep_state() = 0;
  virtual void return_to_kept_state() = 0;
  virtual SavedVectors kept_vectors() = 0;  ///< vectors of the stored state, complete on the first rank; collective
  /// Sets the present state, the stored state and `good_` from a checkpoint.
  virtual void restore_state(const io::Checkpoint& file) = 0;
  virtual void set_time(double t) = 0;                      ///< sets the time of the present and of the stored state
  virtual std::string place_of_least_jacobian() const = 0;  ///< text about the least det F in the stored state
  virtual void choose_quadrature() = 0;
  virtual void estimate_quadrature() = 0;

  Status check_row() const;
  bool is_time_to_save() const;
  void save() {
    if (sink_->keeps_states()) write(good_, kept_vectors());
  }
  /// Writes a checkpoint of `snapshot`. Adds the stored state if `of_sample` has the vectors of this state.
  void write(const Snapshot& snapshot, SavedVectors vectors, std::optional<SavedVectors> of_sample = {});

 private:
  struct NextStepping {
    mechanics::MethodId method;
    double step, local_tolerance;
    std::optional<double> time_error;
    RunIdentity identity;
  };

  Status begin();
  Status choose_stepping();
  Status restore(const io::Checkpoint& file);
  bool repeat_interval(const mechanics::RunResult& failure);
  void step_anew();
  ModelOutcome end(mechanics::RunResult result, Clock::time_point start);
  std::string saved_state() const;
  std::string physical_time(double internal) const;
  ModelOutcome outcome(Outcome end, const std::string& message, Clock::time_point start);

 protected:
  const std::unique_ptr<ModelSink> sink_;
  const bool has_shapes_;  ///< true if the run writes a table of shapes
  mechanics::Counters counters_;
  Status verdict_;                    ///< failure that the model found after a step; such a failure ends the run
  Snapshot good_;                     ///< time, position, memory and counters of the stored state
  std::vector<double> row_;           ///< the row of the last sample
  int steps_since_look_ = 0;          ///< steps since the last check of the clock and of the interrupt flag
  std::vector<double> kept_remarks_;  ///< remarks of the model at the stored state, if intervals can be repeated
  /// Numbers of steps of the intervals so far, if they are recorded. The intervals before the scene changed the
  /// method are left out, because another method cannot repeat them.
  std::vector<long> n_steps_;
  int least_halvings_ = 0;  ///< least position_.halvings if the present interval is repeated; otherwise 0

 private:
  RunIdentity identity_;
  std::optional<NextStepping> next_stepping_;  ///< method and step after the next sample, if they change there
  Clock::time_point last_save_{};
};

template <class Model>
class ModelRun final : public ModelRunBase, private mechanics::AnyHooks<mechanics::State<typename Model::System>> {
  using System = typename Model::System;
  using State = mechanics::State<System>;

 public:
  /// `stepping` is a method and step that another run of the scene found; the program then does not search.
  ModelRun(Model& model, const RunContext& context, const std::optional<Stepping>& stepping = {})
      : ModelRunBase(model, context, traits_of(model.system()), stepping),
        model_(model),
        state_(model.initial_state()),
        good_state_(state_),
        energy_(model, context.scene.time.tolerance, times_.n_samples, watches_every_interval()),
        vectors_(model) {
    good_.t = state_.t;
  }

 private:
  /// Sets a snapshot to a time, the position of the run, and the memory and the counters of the method's workspace.
  using Taker = std::function<void(Snapshot&, double t)>;

  // Hooks of the time loop.
  Status take_sample(long k, const State& state) override {
    // If the first interval is integrated again, the time loop also calls `sample` for k = 0, whose row already exists.
    if (k == 0 && least_halvings_ > 0) return {};
    if (Status status = judge_interval(k, state); !status) return status;
    const double time = context_.time_of_sample(k);
    if (Status status = model_.row(time, state, *workspace_of_system_, row_); !status) return status;
    if (Status status = check_row(); !status) return status;
    measure_constraint(state);
    sink_->append(row_);
    if (sink_->wants_frame(k))
      sink_->draw_frame(k,
                        [&](const auto& path) { return model_.write_frame(path, time, state, *workspace_of_system_); });
    if (has_shapes_ && sink_->wants_shape(k)) sink_->append_shape(model_.shape(time, state));
    if (k > 0 && records_steps()) n_steps_.push_back(position_.steps_in_interval);
    end_interval(k);
    least_halvings_ = 0;
    if (k == 0 || !is_adaptive()) keep(state);
    if (k == 0) save();
    return {};
  }

  long steps_after(long k, const State& state) override {
    if (position_.steps_in_interval > 0) return position_.steps_in_interval;
    if (const auto* given = given_steps()) {
      position_.halvings = std::max(least_halvings_, position_.halvings_after_failure);
      return position_.steps_in_interval = given->at(static_cast<std::size_t>(k)) << position_.halvings;
    }
    if (adapts() && k >= position_.looks.next) reconsider();
    if (repeats_intervals()) {
      if (!kept_volume_) kept_volume_ = look_at(state);  // not known after a resumption
      position_.halvings = std::max({least_halvings_, position_.halvings_after_failure, position_.halvings_for_energy,
                                     halvings_at(state, *kept_volume_)});
    }
    return position_.steps_in_interval = times_.steps_per_interval(std::ldexp(position_.step, -position_.halvings));
  }

  bool goes_on(mechanics::Cursor cursor, const State& state) override {
    position_.cursor = cursor;
    if (Status status = model_.judge(state); !status) {
      verdict_ = std::move(status);
      return false;
    }
    // Steps of an adaptive method do not end at samples. The state is therefore stored after every step.
    if (is_adaptive()) keep(state);
    if (++steps_since_look_ < model_.steps_between_looks) return true;
    steps_since_look_ = 0;
    sink_->progress(state.t / times_.end);
    const bool interrupted = context_.interrupted();
    if (is_time_to_save() || interrupted) {
      Snapshot now;
      take_(now, state.t);
      if (sink_->keeps_states()) {
        std::optional<SavedVectors> of_sample;
        if (repeats_intervals()) of_sample = kept_vectors();
        write(now, vectors_.collect(state_, now), std::move(of_sample));
      }
    }
    return !interrupted;
  }

  static constexpr bool has_constraints = [] {
    if constexpr (mechanics::ConstrainedSystem<System>) return !mechanics::unconstrained<System>;
    return false;
  }();
  static constexpr SystemTraits traits{mechanics::ConstrainedSystem<System>, has_constraints,
                                       mechanics::has_costly_force<System>,
                                       mechanics::method_fits<mechanics::DormandPrince8, System>()};
  /// The traits of this system. A compliant constraint (mechanics/core/constrained_system.h) does not count.
  static SystemTraits traits_of(const System& system) {
    SystemTraits result = traits;
    if (mechanics::is_compliant(system)) result.has_constraints = result.takes_explicit = false;
    return result;
  }

  double time() const override { return state_.t; }
  void set_time(double t) override { state_.t = good_state_.t = good_.t = t; }
  void keep_state() override {
    good_state_ = state_;
    good_.t = state_.t;
  }
  void return_to_kept_state() override { state_ = good_state_; }
  /// Properties of a state that determine the steps of the intervals at this state.
  struct LocalVolume {
    double least_jacobian;
    double rattle_limit = HUGE_VAL;  ///< largest stable step of RATTLE times less_reserve; infinite if not computed
  };
  /// Properties of `state`, the present state. The stable step is computed only if the least det F is at most 0.8.
  LocalVolume look_at(const State& state) const {
    constexpr double violent = 0.8;
    LocalVolume seen{model_.least_jacobian(state)};
    if (double limit = 0; seen.least_jacobian <= violent && rattle_limit(less_reserve, limit))
      seen.rattle_limit = limit;
    return seen;
  }
  /// Least number of halvings, up to most_halvings, with which a step is stable and `keeps_volume` is true at `state`.
  /// It is 0 if `seen` has no stability limit. It does not depend on earlier states or the sign of the velocity.
  int halvings_at(const State& state, const LocalVolume& seen) const {
    if (seen.rattle_limit == HUGE_VAL) return 0;
    int halvings = halvings_within(seen.rattle_limit);
    while (halvings < most_halvings && !model_.keeps_volume(state, std::ldexp(position_.step, -halvings))) ++halvings;
    return halvings;
  }
  /// Fails at the end of an interval that must be integrated again. The reason is that the state at this end requires
  /// shorter steps than those of the interval, or that the energy has changed. The condition is the same for the
  /// interval backwards in time.
  Status judge_interval(long k, const State& state) {
    if (!repeats_intervals() || given_steps()) return {};
    const LocalVolume seen = look_at(state);
    if (model_.has_fronts() && seen.rattle_limit < HUGE_VAL) position_.time_error.reset();
    if (k > 0) {
      least_halvings_ = std::max(least_halvings_, halvings_at(state, seen));
      if (least_halvings_ > position_.halvings) return Status::failure("the motion becomes too fast for the step");
      // The local volume in the stored state is not known if the run was resumed within the interval.
      const double kept = kept_volume_ ? kept_volume_->least_jacobian : model_.least_jacobian(good_state_);
      if (position_.halvings < most_halvings_for_energy &&
          !energy_.keeps_energy(good_state_, kept, state, seen.least_jacobian)) {
        least_halvings_ = position_.halvings + 1;
        position_.energy_has_changed = true;
        return Status::failure("the energy changes");
      }
      position_.n_stable_steps +=
          times_.interval() * std::max(frequency_of_steps(seen), frequency_of_steps(kept_volume_));
    }
    kept_volume_ = seen;
    return {};
  }
  /// The inverse of the largest stable step of RATTLE in a state. If it was not computed for this state, it is that of
  /// the last check of the frequency.
  double frequency_of_steps(const std::optional<LocalVolume>& seen) const {
    if (seen && seen->rattle_limit < HUGE_VAL) return less_reserve / seen->rattle_limit;
    return position_.looks.stable_step > 0 ? 1 / position_.looks.stable_step : 0;
  }
  SavedVectors kept_vectors() override { return vectors_.collect(good_state_, good_); }
  void restore_state(const io::Checkpoint& file) override {
    on_all_ranks(*context_.ranks, [&] {
      vectors_.take(file, good_state_, good_);
      if (!has_last_sample(file)) return;
      last_sample_.emplace(LastSample{good_state_, {}});
      vectors_.take(file, last_sample_->state, last_sample_->snapshot, at_last_sample);
    });
    state_ = good_state_;
  }
  /// After a resumption within an interval, makes the last sample the stored state if intervals can be repeated.
  void keep_last_sample() {
    if (!last_sample_) return;
    if (repeats_intervals()) {
      vectors_.take_own_memory(last_sample_->snapshot);
      good_ = std::move(last_sample_->snapshot);
      good_state_ = std::move(last_sample_->state);
    }
    last_sample_.reset();
  }
  std::string place_of_least_jacobian() const override { return model_.place_of_least_jacobian(good_state_); }
  void choose_quadrature() override { model_.choose_quadrature(state_); }
  void estimate_quadrature() override { model_.estimate_quadrature(state_, position_.looks.stable_step); }

  mechanics::StepChoice choose_step(const mechanics::StepRequest& request) const override {
    State from_zero = model_.start_of_pilot(state_);
    if (!mechanics::time_dependent(model_.system())) from_zero.t = 0;
    if (request.unresolved > 0) leave_oscillation(model_, request.rattle_limit, from_zero);
    const auto Q_of = [this](const State& s) { return model_.configuration(s); };
    if constexpr (traits.has_costly_force)
      return mechanics::choose_step(model_.system(), from_zero, request, Q_of,
                                    [this](const State& s) { return model_.energies(s); });
    else
      return mechanics::choose_step(model_.system(), from_zero, request, Q_of);
  }
  Status rattle_limit(double safety, double& limit) const override {
    return app::rattle_limit(model_, state_, safety, limit);
  }
  Status judge_stiffness(mechanics::StepRequest& request) const override {
    return app::judge_stiffness(model_, state_, request);
  }
  Status unresolved_oscillation(double& error) const override {
    return app::unresolved_oscillation(model_, state_, error);
  }

  mechanics::RunResult run_until(long sample) override {
    mechanics::RunResult result{Outcome::failed, "", state_.t};
    mechanics::with_method(position_.method, [&]<class Method>(Method) {
      if constexpr (mechanics::method_fits<Method, System>())
        result = run_until_with<Method>(sample);
      else  // ModelDescription::takes_method has refused this method
        throw std::logic_error(std::string(Method::name) + " does not fit the model");
    });
    return result;
  }

  template <class Method>
  mechanics::RunResult run_until_with(long sample) {
    const auto& form = mechanics::form_for<Method>(model_.system());
    typename Method::template Workspace<mechanics::FormFor<Method, System>> workspace(form);
    const mechanics::Counters counters = good_.counters;
    on_all_ranks(*context_.ranks, [&] { restore_memory(workspace); });
    workspace.counters = counters;
    if constexpr (Method::adaptive) {
      workspace.tolerance = position_.local_tolerance;
      workspace.h_max = position_.step;
    }
    if constexpr (requires { workspace.most_halvings; })
      if (adapts()) {
        const double tolerance = context_.scene.time.tolerance;
        workspace.tolerance = std::min(workspace.tolerance, tolerance);
        workspace.iteration_tolerance = Method::iteration_tolerance(model_.pilot_reserve * tolerance, times_.end);
      }
    if constexpr (has_constraints && traits.has_costly_force && requires { workspace.constraint_tolerance; })
      workspace.constraint_tolerance =
          std::max(workspace.constraint_tolerance, constraint_tolerance(form) * model_.constraint_scale());
    const mechanics::SampleTimes times{sample == times_.n_samples ? times_.end : times_[sample], sample};
    take_ = [this, &workspace](Snapshot& snapshot, double t) { snapshot.take(position_, t, workspace); };
    workspace_of_system_ = &workspace_of_system(workspace);
    mechanics::AnyHooks<State>& hooks = *this;
    auto result = mechanics::run_time_loop<Method>(form, times, state_, position_.cursor, workspace, hooks);
    if (!verdict_) result = {Outcome::failed, verdict_.reason(), result.t};
    counters_ = workspace.counters;
    if (position_.time_error) statistics_.counters["estimated_time_error"] = *position_.time_error;
    const typename System::Workspace* of_system = nullptr;
    if constexpr (has_workspace_of_system<decltype(workspace)>) of_system = &workspace.system;
    model_.report(counters_, of_system, statistics_);
    return result;
  }

  template <class Workspace>
  static constexpr bool has_workspace_of_system =
      std::is_same_v<decltype(Workspace::system), typename System::Workspace>;
  template <class Workspace>
  typename System::Workspace& workspace_of_system(Workspace& workspace) {
    if constexpr (has_workspace_of_system<Workspace>) {
      return workspace.system;
    } else {
      if (!system_workspace_) system_workspace_.emplace(model_.system().make_workspace());
      return *system_workspace_;
    }
  }

  void keep(const State& state) {
    good_state_ = state;
    take_(good_, state.t);
    if (repeats_intervals()) kept_remarks_ = model_.remarks();
  }

  template <class Workspace>
  void restore_memory(Workspace& workspace) {
    try {
      vectors_.restore_memory(workspace, good_);
      keep_last_sample();
    } catch (const std::invalid_argument&) {
      throw UserError("the checkpoint in " + context_.directory.path().string() + " does not fit its method");
    }
  }

  void measure_constraint(const State& state) {
    if constexpr (has_constraints) {
      if (!traits_.has_constraints) return;
      const double scale = model_.constraint_scale();
      auto residual = model_.system().make_multiplier();
      if (Status status = model_.system().constraint(state.q, residual); !status) return;
      position_.max_constraint = std::max(position_.max_constraint, mechanics::max_norm(residual) / scale);
      model_.system().constraint_rate(state.q, state.v, residual);
      position_.max_constraint_rate = std::max(position_.max_constraint_rate, mechanics::max_norm(residual) / scale);
    }
  }

  Model& model_;
  State state_, good_state_;
  struct LastSample {
    State state;
    Snapshot snapshot;
  };
  std::optional<LastSample> last_sample_;   ///< last sample in the checkpoint, until `keep_last_sample` uses it
  std::optional<LocalVolume> kept_volume_;  ///< local volume of good_state_; empty if it is not computed yet
  EnergyWatch<Model> energy_;
  Taker take_;                                                  ///< takes the workspace of the present method
  typename System::Workspace* workspace_of_system_ = nullptr;   ///< for rows: that of the method, or the next one
  std::optional<typename System::Workspace> system_workspace_;  ///< for rows, if the method's workspace has none
  CheckpointVectors<Model> vectors_;
};

}  // namespace pseudorigid::app
