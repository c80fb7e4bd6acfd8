#pragma once
/// Method and step of one model's run: those of the scene, or those that its tolerance asks for.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "app/run/model_checkpoint.h"
#include "app/run/run_context.h"
#include "app/run/search_notice.h"
#include "io/signals.h"
#include "mechanics/steps/largest_frequency.h"
#include "mechanics/steps/step_size.h"

namespace pseudorigid::app {

/// Calls visitor(Method{}) of the method of that id. Throws std::logic_error if it cannot be compiled for the system: a
/// scene with such a method is refused (ModelDescription::takes_method).
template <class System, class Visitor>
void with_fitting_method(mechanics::MethodId id, Visitor&& visitor) {
  mechanics::with_method(id, [&]<class Method>(Method method) {
    if constexpr (mechanics::method_fits<Method, System>())
      visitor(method);
    else
      throw std::logic_error(std::string(Method::name) + " does not fit the model");
  });
}

/// Warns if the tolerance is below the accuracy of the arithmetic.
inline void warn_of_round_off(const mechanics::StepChoice& choice, std::string_view model, const RunContext& context) {
  if (choice.round_off_rules_from)
    context.log->warn(
        "{}: the motion is unstable: within a time of {:.6g} round-off grows beyond the tolerance, and to {:.1e} by "
        "the "
        "end, so that the end depends on the last digits of the arithmetic",
        model, *choice.round_off_rules_from * context.units.time, choice.error);
  else if (choice.at_round_off)
    context.log->warn(
        "{}: the tolerance is below the accuracy of double precision over this run; the estimate is {:.1e}", model,
        choice.error);
}

template <class Model>
class ModelStepping {
  using System = typename Model::System;
  using State = mechanics::State<System>;
  using Status = mechanics::Status;

 public:
  /// `known`: found by another run of the scene, in place of a search.
  ModelStepping(const Model& model, const RunContext& context, const std::optional<Stepping>& known, double end,
                double interval)
      : model_(model), context_(context), known_(known), end_(end), interval_(interval) {}

  /// Sets method, step and local tolerance of the position for the rest of the run from `state` on. A choice by the
  /// search is logged and noted in the statistics.
  Status choose(const State& state, RunPosition& position, io::Manifest::Model& statistics) const {
    const std::optional<double> error_so_far = std::exchange(position.time_error, std::nullopt);
    if (known_) return take_over(*known_, state, position);
    const double bound = step_bound();
    if (const auto method = asked_method(); method && std::isfinite(bound) && !is_adaptive(*method)) {
      position.method = *method;
      position.step = bound;
      return {};
    }
    return search(state, error_so_far, position, statistics);
  }

  std::optional<mechanics::MethodId> asked_method() const {  // nothing: auto
    return mechanics::find_method(context_.scene.time.method);
  }

  /// Whether the step that the scene gives only makes that of the position shorter.
  bool shortens(const RunPosition& position) const {
    return std::isfinite(step_bound()) && step_bound() <= position.step * (1 + 1e-12);
  }
  void shorten(RunPosition& position) const { position.step = std::min(position.step, step_bound()); }

  /// Halves the step, once or more, if the motion has raised the largest frequency above the stability limit of the
  /// step.
  void reconsider(const State& state, RunPosition& position) const {
    if constexpr (mechanics::ConstrainedSystem<System>) {
      position.looks.next = position.cursor.sample + samples_between_looks();
      double limit = 0;
      // Between `reserve`, with which steps are chosen, and 1, where they are unstable: a step is not halved for the
      // few per cent by which the frequency of a motion comes and goes, and not kept until it is at its limit.
      constexpr double less_reserve = 0.9;
      if (!rattle_limit(state, less_reserve, limit)) return;  // the step itself will meet the failure and report it
      const double before = position.step;
      while (position.step > limit_of(position.method, limit)) position.step /= 2;
      plan_look(limit / less_reserve, position);
      if (position.step != before)
        context_.log->info("{}: step reduced to {:.4g} at t = {:.6g}, because the stiffness has grown", model_.name,
                           position.step * context_.units.time, state.t * context_.units.time);
    }
  }

  /// Whether the step may change along the motion, because the scene does not fix it.
  bool adapts(const RunPosition& position) const { return !context_.scene.time.step && !is_adaptive(position.method); }

  /// Tolerance of the scaled constraint, for systems whose Gram systems cost iterations. A step that is looked for
  /// meets it to what the tolerance of the motion asks for: at 1e-4 of that, errors of the motion and steps found are
  /// those of 1e-13 to three digits.
  double constraint_tolerance() const {
    const auto& time = context_.scene.time;
    constexpr double part = 1e-4;
    return time.constraint_tolerance.value_or(time.step ? 0 : part * time.tolerance);
  }

  static bool is_adaptive(mechanics::MethodId id) {
    return mechanics::with_method(id, []<class Method>(Method) { return Method::adaptive; });
  }

 private:
  static constexpr int n_lanczos = 24;
  /// Relative accuracy of ω² if a force is expensive: a step shorter by a hundredth costs less than a better estimate.
  static constexpr double accuracy = mechanics::has_costly_force<System> ? 0.02 : 0;
  /// A step is at most this part of the stability limit at the state for which it was chosen.
  static constexpr double reserve = 0.8;

  double step_bound() const {
    return context_.scene.time.step ? context_.internal_time(*context_.scene.time.step) : HUGE_VAL;
  }

  Status search(const State& state, const std::optional<double>& error_so_far, RunPosition& position,
                io::Manifest::Model& statistics) const {
    mechanics::StepRequest request{.end = end_ - state.t,
                                   .window = model_.pilot_window(end_ - state.t),
                                   .tolerance = Model::pilot_reserve * context_.scene.time.tolerance,
                                   .step_bound = std::min(step_bound(), end_ - state.t),
                                   .interval = interval_,
                                   .spare_pilots = mechanics::has_costly_force<System>,
                                   .method = asked_method()};
    if constexpr (mechanics::ConstrainedSystem<System>) {
      double limit = 0;
      if (Status status = rattle_limit(state, reserve, limit); !status) return status;
      request.rattle_limit = std::min(limit, request.end);
      if (Status status = judge_stiffness(state, request); !status) return status;
    } else {
      request.rattle_limit = HUGE_VAL;  // accuracy and the iteration of the stages bound the step
    }
    SearchNotice notice(context_, model_.name, about_search(request), Model::steps_between_looks);
    request.give_up = [&] {
      notice.step();
      return context_.interrupted();
    };
    State from_zero = state;
    if (!mechanics::time_dependent(model_.system())) from_zero.t = 0;
    const auto choice = mechanics::choose_step(
        model_.system(), from_zero, request, [&](const State& s) { return model_.configuration(s); }, energies());
    // If the search for the step was interrupted, the run does not start.
    if (context_.interrupted()) return Status::failure("interrupted while looking for the step");
    if (!choice.status)
      fall_back(choice, request, position);
    else
      take(choice, error_so_far, position, statistics);
    plan_look(request.rattle_limit / reserve, position);
    return {};
  }

  /// Energies of a state, if the model has them.
  auto energies() const {
    if constexpr (requires(const State& s) { model_.energies(s); })
      return [this](const State& s) { return model_.energies(s); };
    else
      return mechanics::detail::NoEnergies{};
  }

  Status rattle_limit(const State& state, double safety, double& limit) const {
    auto workspace = model_.system().make_workspace();
    const auto frequency = mechanics::largest_frequency(model_.system(), state, workspace, n_lanczos, accuracy);
    if (!frequency.status) return frequency.status;
    limit = mechanics::rattle_step_limit(frequency.omega, model_.rate(state), safety);
    if constexpr (!mechanics::LinearlyDamped<System>) {
      const auto damping =
          mechanics::largest_damping(model_.system(), state, workspace, frequency.omega, n_lanczos, accuracy);
      if (!damping.status) return damping.status;
      limit = std::min(limit, mechanics::damped_step_limit(damping.gamma, safety));
    }
    return {};
  }

  /// An explicit method makes some γh steps, γ the largest rate of damping, where RATTLE makes one of length h.
  Status judge_stiffness(const State& state, mechanics::StepRequest& request) const {
    if constexpr (mechanics::LinearlyDamped<System>) {
      constexpr double most_steps = mechanics::has_costly_force<System> ? 30 : 100;
      auto workspace = model_.system().make_workspace();
      const double h = request.rattle_limit, omega = mechanics::Rattle::stability_limit / h;
      const auto damping = mechanics::largest_damping(model_.system(), state, workspace, omega, n_lanczos, 0.1);
      if (!damping.status) return damping.status;
      request.stiff = damping.gamma * h > most_steps;
    }
    return {};
  }

  std::string about_search(const mechanics::StepRequest& request) const {
    const double time = context_.units.time;
    std::string text = fmt::format("looks for method and step by pilot runs, until {:.4g} of {:.4g}",
                                   mechanics::detail::pilot_window(request) * time, request.end * time);
    if (request.rattle_limit > 0)
      text += fmt::format("; rattle is stable up to a step of {:.2g}, which the run takes {:.2g} times",
                          request.rattle_limit * time, std::ceil(request.end / request.rattle_limit));
    return text;
  }

  /// RATTLE's limit, for a method of fixed steps.
  static double limit_of(mechanics::MethodId id, double rattle_limit) {
    return mechanics::with_method(id, [&]<class Method>(Method) {
      if constexpr (Method::adaptive)
        return HUGE_VAL;
      else
        return rattle_limit * (Method::stability_limit / mechanics::Rattle::stability_limit);
    });
  }

  /// The largest frequency changes with the deformation. The next look comes before it can have grown beyond what the
  /// step stands, if it grows no faster than twice as fast as it has changed from look to look so far; of the first
  /// look nothing is known but that it is a sixteenth of the run away, or later for a step with much room.
  void plan_look(double stable_rattle_step, RunPosition& position) const {
    if constexpr (mechanics::ConstrainedSystem<System>) {
      LooksAtFrequency& looks = position.looks;
      const long now = position.cursor.sample, between = samples_between_looks();
      if (looks.stable_step > 0 && now > looks.last)
        looks.fastest_change =
            std::max(looks.fastest_change, std::abs(std::log(stable_rattle_step / looks.stable_step)) /
                                               static_cast<double>(now - looks.last));
      const double room = std::log(limit_of(position.method, stable_rattle_step) / position.step);
      const double usual = std::log(1 / reserve) / static_cast<double>(between);
      const double growth = looks.stable_step > 0 ? std::max(2 * looks.fastest_change, usual / 3) : usual;
      const long n_samples = static_cast<long>(std::clamp(room / growth, 1.0, 16.0 * static_cast<double>(between)));
      looks = {now + std::max(between, n_samples), now, stable_rattle_step, looks.fastest_change};
    }
  }
  long samples_between_looks() const { return std::max(1L, std::lround(end_ / interval_) / 16); }

  /// Method and step found by another run, with a step no longer than the stability limit of this one.
  Status take_over(const Stepping& known, const State& state, RunPosition& position) const {
    position.method = known.method;
    position.step = known.step;
    if constexpr (mechanics::ConstrainedSystem<System>) {
      double limit = 0;
      if (Status status = rattle_limit(state, reserve, limit); !status) return status;
      position.step = std::min(known.step, limit_of(known.method, limit));
      plan_look(limit / reserve, position);
    }
    return {};
  }

  /// The motion itself may break off within the pilot's window; the run shall get as far as it can and say where.
  void fall_back(const mechanics::StepChoice& choice, const mechanics::StepRequest& request,
                 RunPosition& position) const {
    using Explicit = mechanics::DormandPrince8;
    constexpr bool explicit_fits = mechanics::method_fits<Explicit, System>();
    position.method =
        request.method.value_or(explicit_fits ? mechanics::id_of<Explicit> : mechanics::id_of<mechanics::Rattle>);
    position.local_tolerance = std::max(1e-3 * request.tolerance, 1e-14);
    position.step =
        std::min({request.step_bound, request.interval, 0.5 * limit_of(position.method, request.rattle_limit)});
    context_.log->warn("{}: the step cannot be fitted to the tolerance ({}); {} with {} {:.4g}", model_.name,
                       choice.status.reason(), mechanics::method_name(position.method),
                       is_adaptive(position.method) ? "the local tolerance" : "half the stable step",
                       is_adaptive(position.method) ? position.local_tolerance : position.step * context_.units.time);
  }

  void take(const mechanics::StepChoice& choice, const std::optional<double>& error_so_far, RunPosition& position,
            io::Manifest::Model& statistics) const {
    position.method = choice.method;
    position.step = choice.step;
    position.local_tolerance = choice.local_tolerance;
    statistics.counters["pilot_forces"] += static_cast<double>(choice.n_force);
    if (error_so_far) position.time_error = *error_so_far + choice.error;
    if (is_adaptive(choice.method))
      context_.log->info("{}: {}, local tolerance {:.1e} (estimated time error {:.1e})", model_.name,
                         mechanics::method_name(choice.method), choice.local_tolerance, choice.error);
    else
      context_.log->info("{}: {}{}, step {:.4g} (estimated time error {:.1e})", model_.name,
                         mechanics::method_name(choice.method), promise(choice.method),
                         choice.step * context_.units.time, choice.error);
    warn_of_round_off(choice, model_.name, context_);
    context_.log->debug("{}: {}", model_.name, choice.why);
  }

  /// Log suffix that names a property the method lacks.
  static std::string_view promise(mechanics::MethodId id) {
    return mechanics::with_method(id, []<class Method>(Method) {
      return Method::symplectic ? std::string_view() : std::string_view(" (symmetric, not symplectic)");
    });
  }

  const Model& model_;
  const RunContext& context_;
  std::optional<Stepping> known_;
  double end_, interval_;
};

}  // namespace pseudorigid::app
