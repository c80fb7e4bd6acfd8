#pragma once
/// Choice of the method and the step of one model's run. The scene gives the method and the step, or the program finds
/// them for the tolerance of the scene.

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "app/run/model_checkpoint.h"
#include "app/run/run_context.h"
#include "app/run/runnable_model.h"
#include "mechanics/steps/step_size.h"
#include "scene/stabilization.h"

namespace pseudorigid::app {

/// Logs a warning if the motion is so unstable that round-off grows beyond the tolerance. Otherwise logs a warning if
/// the tolerance is below the accuracy of double precision over the run. `model` is the name of the model for the
/// message.
void warn_of_round_off(const mechanics::StepChoice& choice, std::string_view model, const RunContext& context);

/// Properties of the type of a system that affect the choice of the step and the run.
struct SystemTraits {
  bool constrained_form;  ///< true for a mechanics::ConstrainedSystem, with constraints or without
  bool has_constraints,
      has_costly_force;  ///< whether there are multipliers, and whether a force evaluation is costly
                         ///< (mechanics/core/constrained_system.h)
  bool takes_explicit;   ///< true if the explicit method of order 8 fits the system
};

/// The part of a run that chooses its method and step. It is the base class of ModelRunBase.
class ModelStepping {
 public:
  virtual ~ModelStepping() = default;

 protected:
  using Status = mechanics::Status;

  /// `known` is the method and step that another run of the scene found, or empty. If `known` is not empty, the program
  /// does not search. The step is then reduced only if it is too large for the stability of this run.
  ModelStepping(RunnableModel& model, const RunContext& context, const SystemTraits& traits,
                const std::optional<Stepping>& known)
      : any_model_(model),
        context_(context),
        traits_(traits),
        known_(known),
        times_{context.internal_time(context.scene.time.end), context.scene.output.samples} {}

  // Functions that depend on the system of the run.

  /// The present time of the run in internal units.
  virtual double time() const = 0;
  /// Sets `limit` to the largest stable step of RATTLE times `safety`. Fails if a frequency or a damping rate is not
  /// found. Called only for systems in constrained form.
  virtual Status rattle_limit(double safety, double& limit) const = 0;
  /// Sets request.stiff to true if the damping would force an explicit method to take too many steps. Called only for
  /// systems in constrained form.
  virtual Status judge_stiffness(mechanics::StepRequest& request) const = 0;
  /// Sets `error` to a bound of the error of Q that a fast oscillation causes if steps do not resolve it. It is 0
  /// unless the constraint is compliant (mechanics/steps/compliance_oscillation.h). Fails if the bound cannot be
  /// computed.
  virtual Status unresolved_oscillation(double& error) const = 0;
  /// Searches for the method and the step by pilot runs, which begin with start_of_pilot(present state). If steps need
  /// not resolve an oscillation, the pilot runs begin without it (mechanics/steps/slow_motion.h).
  virtual mechanics::StepChoice choose_step(const mechanics::StepRequest& request) const = 0;

  /// Sets the method, the step and the local tolerance for the rest of the run. If the program searches for them, it
  /// logs the choice and counts the force evaluations of the search in the statistics. It then adds the estimated time
  /// error to position_.time_error; without a search, this member becomes empty. Fails if the stability limit or a rate
  /// of damping cannot be computed, or if the search is interrupted.
  Status choose();

  /// True if the scene gives a step that does not exceed the present step.
  bool shortens() const { return std::isfinite(step_bound()) && step_bound() <= position_.step * (1 + 1e-12); }
  /// Replaces the present step by the step of the scene, if this is shorter.
  void shorten() { position_.step = std::min(position_.step, step_bound()); }

  /// Checks the largest frequency of small vibrations, and halves the step until it is at most 0.9 of the stability
  /// limit. Plans the sample of the next check. Does nothing if the system is not in constrained form. If the frequency
  /// is not found, the step does not change.
  void reconsider();

  bool is_adaptive() const { return is_adaptive(position_.method); }
  /// True if the step can change during the run: the scene does not give the step, and the method is not adaptive.
  bool adapts() const { return !context_.scene.time.step && !is_adaptive(); }

  /// True if a failed interval between samples is integrated again with shorter steps: force evaluations are costly,
  /// and the step can change.
  bool repeats_intervals() const { return traits_.has_costly_force && adapts(); }
  /// True if the energy of every interval is checked, and not only of those with a small det F (energy_watch.h).
  bool watches_every_interval() const { return any_model_.has_fronts() && scene::starts_violently(context_.scene); }
  /// True if the numbers of steps are recorded, for the estimate of the time error (search/time_error.h).
  bool records_steps() const { return repeats_intervals() && context_.needs.comparison; }
  /// Sets the position of the run at the sample k, the end of an interval. If three intervals in succession were
  /// integrated again because the energy changed, the next interval has as many halvings as the last of them. Each
  /// later interval without such a change has one halving less. If a change then asks for only one halving more, eight
  /// intervals keep this number first. Otherwise every second interval of a motion that is violent for a long time
  /// would be integrated twice.
  void end_interval(long k);
  /// The numbers of steps of the intervals if another run gives them; null if this run chooses them.
  const std::vector<long>* given_steps() const {
    return known_ && !known_->n_steps.empty() ? &known_->n_steps : nullptr;
  }
  /// Least number of halvings after which the step is at most the step limit of the method. This limit is proportional
  /// to `rattle_limit`, the largest permitted step of RATTLE. If `most_halvings` halvings do not suffice, the result is
  /// `most_halvings`.
  int halvings_within(double rattle_limit) const;

  /// Tolerance of the constraint divided by constraint_scale, for systems with a costly force. It is the value of
  /// Time/Constraint tolerance if the scene gives one. Otherwise it is 0 if the scene gives the step, and else 1e-4 of
  /// Time/Tolerance, or 1e-8 of it if forces dissipate energy. The method uses the larger of this tolerance and the
  /// tolerance of the system. Compared with the tolerance 1e-13, the value 1e-4 Time/Tolerance changes errors and steps
  /// by less than a thousandth. However, the error ε of ln det F changes from step to step, so a viscosity η dissipates
  /// about 2η(ε/h)² with the step h. This power may exceed that of a slow and small motion, such as a tide.
  template <class S>
  double constraint_tolerance(const S& system) const {
    const auto& time = context_.scene.time;
    const double part = mechanics::dissipative(system) || mechanics::relaxes(system) ? 1e-8 : 1e-4;
    return time.constraint_tolerance.value_or(time.step ? 0 : part * time.tolerance);
  }
  /// Ratio of a step to the stability limit above which the step is halved. When a step is chosen, the ratio is at most
  /// 0.8. An oscillation of the frequency by a few per cent therefore does not halve the step. If the ratio increases,
  /// the step is halved before it becomes unstable at the ratio 1.
  static constexpr double less_reserve = 0.9;
  /// Largest number of halvings of the step in one interval between samples.
  static constexpr int most_halvings = 8;
  /// Largest number of halvings of the step in one interval because of a change of the energy.
  static constexpr int most_halvings_for_energy = 7;

  RunnableModel& any_model_;
  const RunContext& context_;
  const SystemTraits traits_;
  const std::optional<Stepping> known_;  ///< method and step that another run found; empty if there are none
  const mechanics::SampleTimes times_;
  RunPosition position_;
  io::Manifest::Model statistics_;

 private:
  static bool is_adaptive(mechanics::MethodId id) {
    return mechanics::with_method(id, []<class Method>(Method) { return Method::adaptive; });
  }
  std::optional<mechanics::MethodId> asked_method() const {  // empty for auto
    return mechanics::find_method(context_.scene.time.method);
  }
  /// The step of the scene in internal time; infinite if the scene does not give it.
  double step_bound() const {
    return context_.scene.time.step ? context_.internal_time(*context_.scene.time.step) : HUGE_VAL;
  }
  /// Least number of samples between two checks of the largest frequency: a sixteenth of the run, but at least 1.
  long samples_between_looks() const { return std::max(1L, std::lround(times_.end / times_.interval()) / 16); }
  Status search(const std::optional<double>& error_so_far);
  std::string about_search(const mechanics::StepRequest& request) const;
  void plan_look(double stable_rattle_step);
  Status take_over(const Stepping& known);
  void fall_back(const mechanics::StepChoice& choice, const mechanics::StepRequest& request);
  void take(const mechanics::StepChoice& choice, const std::optional<double>& error_so_far);
};

}  // namespace pseudorigid::app
