#pragma once
/// Method and step of one model's run: those of the scene, or those that its tolerance asks for.

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

namespace pseudorigid::app {

/// Warns if the tolerance is below the accuracy of the arithmetic.
void warn_of_round_off(const mechanics::StepChoice& choice, std::string_view model, const RunContext& context);

/// Properties of a system's type on which the choice and the run depend.
struct SystemTraits {
  bool constrained_form;  ///< ConstrainedSystem, with constraints or without
  bool has_constraints, has_costly_force, is_distributed;
  bool takes_explicit;  ///< explicit-8
};

/// The part of a run that chooses its method and step.
class ModelStepping {
 public:
  virtual ~ModelStepping() = default;

 protected:
  using Status = mechanics::Status;

  /// `known`: found by another run of the scene, in place of a search.
  ModelStepping(RunnableModel& model, const RunContext& context, const SystemTraits& traits,
                const std::optional<Stepping>& known)
      : any_model_(model),
        context_(context),
        traits_(traits),
        known_(known),
        times_{context.internal_time(context.scene.time.end), context.scene.output.samples} {}

  // The state of the run.
  virtual double time() const = 0;
  /// Largest stable step of RATTLE; called only for systems in constrained form.
  virtual Status rattle_limit(double safety, double& limit) const = 0;
  /// Sets request.stiff.
  virtual Status judge_stiffness(mechanics::StepRequest& request) const = 0;
  virtual mechanics::StepChoice choose_step(const mechanics::StepRequest& request) const = 0;

  /// Sets method, step and local tolerance for the rest of the run. A choice by the search is logged and noted in the
  /// statistics.
  Status choose();

  /// Whether the step that the scene gives only makes the present one shorter.
  bool shortens() const { return std::isfinite(step_bound()) && step_bound() <= position_.step * (1 + 1e-12); }
  void shorten() { position_.step = std::min(position_.step, step_bound()); }

  /// Halves the step, once or more, if the motion has raised the largest frequency above the stability limit of the
  /// step.
  void reconsider();

  bool is_adaptive() const { return is_adaptive(position_.method); }
  /// Whether the step may change along the motion, because the scene does not fix it.
  bool adapts() const { return !context_.scene.time.step && !is_adaptive(); }

  /// Tolerance of the scaled constraint, for systems that solve their Gram systems by iteration. A step found by a
  /// search meets the constraint to 1e-4 of the tolerance of the motion. Errors of the motion and steps then agree with
  /// those at 1e-13 to three digits.
  double constraint_tolerance() const {
    const auto& time = context_.scene.time;
    constexpr double part = 1e-4;
    return time.constraint_tolerance.value_or(time.step ? 0 : part * time.tolerance);
  }

  RunnableModel& any_model_;
  const RunContext& context_;
  const SystemTraits traits_;
  const std::optional<Stepping> known_;
  const mechanics::SampleTimes times_;
  RunPosition position_;
  io::Manifest::Model statistics_;

 private:
  static bool is_adaptive(mechanics::MethodId id) {
    return mechanics::with_method(id, []<class Method>(Method) { return Method::adaptive; });
  }
  std::optional<mechanics::MethodId> asked_method() const {  // nothing: auto
    return mechanics::find_method(context_.scene.time.method);
  }
  double step_bound() const {
    return context_.scene.time.step ? context_.internal_time(*context_.scene.time.step) : HUGE_VAL;
  }
  long samples_between_looks() const { return std::max(1L, std::lround(times_.end / times_.interval()) / 16); }
  Status search(const std::optional<double>& error_so_far);
  std::string about_search(const mechanics::StepRequest& request) const;
  void plan_look(double stable_rattle_step);
  Status take_over(const Stepping& known);
  void fall_back(const mechanics::StepChoice& choice, const mechanics::StepRequest& request);
  void take(const mechanics::StepChoice& choice, const std::optional<double>& error_so_far);
};

}  // namespace pseudorigid::app
