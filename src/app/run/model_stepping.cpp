#include "app/run/model_stepping.h"

#include <fmt/format.h>

#include <chrono>

namespace pseudorigid::app {
namespace {

/// Messages about a search for method and step that takes longer than a second. The first message describes the search.
/// Later messages, after ten seconds, a hundred seconds and so on, state that the search continues.
class SearchNotice {
 public:
  /// `what` is the text of the first message after the name of the model, for example "looks for method and step …".
  SearchNotice(const RunContext& context, std::string model, std::string what, int steps_between_looks)
      : context_(context),
        model_(std::move(model)),
        what_(std::move(what)),
        steps_between_looks_(steps_between_looks) {}

  /// Writes a message if one is due. Called after every step of a pilot run.
  void step() {
    if (++n_steps_ < steps_between_looks_) return;
    n_steps_ = 0;
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    if (seconds < next_) return;
    if (next_ == first_)
      context_.log->info("{}: {}", model_, what_);
    else
      context_.log->info("{}: still looking for the step, after {:.0f} s", model_, seconds);
    while (next_ <= seconds) next_ *= 10;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr double first_ = 1;  ///< seconds until the first message

  const RunContext& context_;
  std::string model_, what_;
  int steps_between_looks_;
  Clock::time_point start_ = Clock::now();
  int n_steps_ = 0;
  double next_ = first_;  ///< seconds until the next message
};

/// Largest ratio of a step to the stability limit when the step is chosen. The largest frequency of the motion can then
/// grow by a quarter before the step is unstable.
constexpr double reserve = 0.8;

/// Stability limit of the step of a method, computed from the limit `rattle_limit` of RATTLE; infinite for adaptive
/// methods.
double limit_of(mechanics::MethodId id, double rattle_limit) {
  return mechanics::with_method(id, [&]<class Method>(Method) {
    if constexpr (Method::adaptive)
      return HUGE_VAL;
    else
      return rattle_limit * (Method::stability_limit / mechanics::Rattle::stability_limit);
  });
}

/// Text for the log after the name of a method that is not symplectic; empty for symplectic methods.
std::string_view promise(mechanics::MethodId id) {
  return mechanics::with_method(id, []<class Method>(Method) {
    return Method::symplectic ? std::string_view() : std::string_view(" (symmetric, not symplectic)");
  });
}

}  // namespace

void warn_of_round_off(const mechanics::StepChoice& choice, std::string_view model, const RunContext& context) {
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

mechanics::Status ModelStepping::choose() {
  const std::optional<double> error_so_far = std::exchange(position_.time_error, std::nullopt);
  if (known_) return take_over(*known_);
  const double bound = step_bound();
  if (const auto method = asked_method(); method && std::isfinite(bound) && !is_adaptive(*method)) {
    position_.method = *method;
    position_.step = bound;
    return {};
  }
  return search(error_so_far);
}

void ModelStepping::reconsider() {
  if (!traits_.constrained_form) return;
  position_.looks.next = position_.cursor.sample + samples_between_looks();
  double limit = 0;
  if (!rattle_limit(less_reserve, limit)) return;  // the next step fails for the same reason and reports the reason
  const double before = position_.step;
  while (position_.step > limit_of(position_.method, limit)) position_.step /= 2;
  plan_look(limit / less_reserve);
  if (position_.step != before)
    context_.log->info("{}: step reduced to {:.4g} at t = {:.6g}, because the stiffness has grown", any_model_.name,
                       position_.step * context_.units.time, time() * context_.units.time);
}

void ModelStepping::end_interval(long k) {
  constexpr int often = 3, hold = 8;
  position_.cursor = {k, 0};
  position_.steps_in_interval = 0;
  position_.halvings_after_failure = std::max(0, position_.halvings_after_failure - 1);
  int& halvings = position_.halvings_for_energy;
  position_.n_changes_of_energy = position_.energy_has_changed ? position_.n_changes_of_energy + 1 : 0;
  position_.energy_has_changed = false;
  if (position_.n_changes_of_energy >= often || (position_.n_changes_of_energy > 0 && halvings > 0)) {
    position_.n_held = position_.halvings <= halvings + 1 ? hold : 1;
    halvings = std::min(position_.halvings, most_halvings_for_energy);
  } else if (halvings > 0 && --position_.n_held <= 0) {
    --halvings;
    position_.n_held = 1;
  }
}

int ModelStepping::halvings_within(double rattle_limit) const {
  const double ratio = position_.step / limit_of(position_.method, rattle_limit);
  return ratio > 1 ? std::min(most_halvings, static_cast<int>(std::ceil(std::log2(ratio)))) : 0;
}

/// Finds method and step by pilot runs. Fails if the stability limit or a rate of damping cannot be computed, or after
/// an interrupt. If no step fits the tolerance, chooses one by `fall_back` and does not fail. `error_so_far` is the
/// time error of the earlier parts of the run; empty if it is not known.
mechanics::Status ModelStepping::search(const std::optional<double>& error_so_far) {
  const double end = times_.end - time();
  mechanics::StepRequest request{.end = end,
                                 .window = any_model_.pilot_window(end),
                                 .tolerance = any_model_.pilot_reserve * context_.scene.time.tolerance,
                                 .step_bound = std::min(step_bound(), end),
                                 .interval = times_.interval(),
                                 .spare_pilots = traits_.has_costly_force,
                                 .watches_energy = repeats_intervals() && watches_every_interval(),
                                 .method = asked_method()};
  if (traits_.constrained_form) {
    double limit = 0;
    if (Status status = rattle_limit(reserve, limit); !status) return status;
    request.rattle_limit = std::min(limit, request.end);
    if (Status status = judge_stiffness(request); !status) return status;
  } else {
    request.rattle_limit = HUGE_VAL;  // only accuracy and the convergence of iterations bound the step
  }
  // If the oscillation exceeds the tolerance, shorter steps may resolve it.
  if (!unresolved_oscillation(request.unresolved) || request.unresolved > context_.scene.time.tolerance)
    request.unresolved = 0;
  SearchNotice notice(context_, any_model_.name, about_search(request), any_model_.steps_between_looks);
  request.give_up = [&] {
    notice.step();
    return context_.interrupted();
  };
  const mechanics::StepChoice choice = choose_step(request);
  // If the search for the step was interrupted, the run does not start.
  if (context_.interrupted()) return Status::failure("interrupted while looking for the step");
  if (!choice.status)
    fall_back(choice, request);
  else
    take(choice, error_so_far);
  plan_look(request.rattle_limit / reserve);
  return {};
}

/// The predicate of the first message about a long search (SearchNotice), with times in the user's units.
std::string ModelStepping::about_search(const mechanics::StepRequest& request) const {
  const double time = context_.units.time;
  std::string text = fmt::format("looks for method and step by pilot runs, until {:.4g} of {:.4g}",
                                 mechanics::detail::pilot_window(request) * time, request.end * time);
  if (request.rattle_limit > 0)
    text += fmt::format("; rattle is stable up to a step of {:.2g}, which the run takes {:.2g} times",
                        request.rattle_limit * time, std::ceil(request.end / request.rattle_limit));
  return text;
}

/// Chooses the sample of the next check of the largest frequency. `stable_rattle_step` is the stability limit of RATTLE
/// now, to which the limit of the method in use is proportional. If the frequency grows, both limits fall. The next
/// check is at the time at which the limit of the method would have fallen to the step. The assumed rate of change of
/// the logarithm of the limit is twice the fastest change between two checks so far, but at least a third of the usual
/// rate. At the usual rate, the limit falls to 0.8 of its value in a sixteenth of the run. The first plan uses the
/// usual rate. The next check is at least a sixteenth of the run after the present sample. Does nothing if the system
/// is not in constrained form.
void ModelStepping::plan_look(double stable_rattle_step) {
  if (!traits_.constrained_form) return;
  LooksAtFrequency& looks = position_.looks;
  const long now = position_.cursor.sample, between = samples_between_looks();
  if (looks.stable_step > 0 && now > looks.last)
    looks.fastest_change = std::max(looks.fastest_change, std::abs(std::log(stable_rattle_step / looks.stable_step)) /
                                                              static_cast<double>(now - looks.last));
  const double room = std::log(limit_of(position_.method, stable_rattle_step) / position_.step);
  const double usual = std::log(1 / reserve) / static_cast<double>(between);
  const double growth = looks.stable_step > 0 ? std::max(2 * looks.fastest_change, usual / 3) : usual;
  const long n_samples = static_cast<long>(std::clamp(room / growth, 1.0, 16.0 * static_cast<double>(between)));
  looks = {now + std::max(between, n_samples), now, stable_rattle_step, looks.fastest_change};
}

/// Sets the method and step that another run found. For systems in constrained form, the step is at most 0.8 of the
/// stability limit of this run. Fails if this limit cannot be computed.
mechanics::Status ModelStepping::take_over(const Stepping& known) {
  position_.method = known.method;
  position_.step = known.step;
  position_.local_tolerance = known.local_tolerance;
  if (traits_.constrained_form) {
    double limit = 0;
    if (Status status = rattle_limit(reserve, limit); !status) return status;
    position_.step = std::min(position_.step, limit_of(known.method, limit));
    plan_look(limit / reserve);
  }
  return {};
}

/// Chooses method and step after a search without result. The method is that of the scene, or explicit-8. If explicit-8
/// does not fit the system, the method is RATTLE, or the last method of the search if the energy of every interval is
/// checked. The step is half of the stable step, or the local tolerance is small. A possible cause is that the motion
/// itself ends within a pilot run. The run then continues as long as possible and reports the time at which it stopped.
void ModelStepping::fall_back(const mechanics::StepChoice& choice, const mechanics::StepRequest& request) {
  using Explicit = mechanics::DormandPrince8;
  position_.method = request.method.value_or(traits_.takes_explicit   ? mechanics::id_of<Explicit>
                                             : request.watches_energy ? choice.method
                                                                      : mechanics::id_of<mechanics::Rattle>);
  position_.local_tolerance = std::max(1e-3 * request.tolerance, 1e-14);
  position_.step =
      std::min({request.step_bound, request.interval, 0.5 * limit_of(position_.method, request.rattle_limit)});
  context_.log->warn("{}: the step cannot be fitted to the tolerance ({}); {} with {} {:.4g}", any_model_.name,
                     choice.status.reason(), mechanics::method_name(position_.method),
                     is_adaptive(position_.method) ? "the local tolerance" : "half the stable step",
                     is_adaptive(position_.method) ? position_.local_tolerance : position_.step * context_.units.time);
}

/// Sets the method and step of a successful search, and logs the choice. Adds the force evaluations of the search to
/// the statistics. The time error of the run becomes the sum of `error_so_far` and the estimated error. If
/// `error_so_far` is empty, the time error remains empty.
void ModelStepping::take(const mechanics::StepChoice& choice, const std::optional<double>& error_so_far) {
  position_.method = choice.method;
  position_.step = choice.step;
  position_.local_tolerance = choice.local_tolerance;
  statistics_.counters["pilot_forces"] += static_cast<double>(choice.n_force);
  double oscillation = 0;
  const bool is_known = unresolved_oscillation(oscillation).ok();
  if (error_so_far && is_known) position_.time_error = *error_so_far + choice.error + oscillation;
  if (const double tolerance = context_.scene.time.tolerance; oscillation > tolerance)
    context_.log->warn(
        "{}: the step cannot be fitted to the tolerance: pressure waves are not resolved and change Q by up to {:.1e}; "
        "Material/Bulk = pointwise resolves them",
        any_model_.name, oscillation);
  if (is_adaptive(choice.method))
    context_.log->info("{}: {}, local tolerance {:.1e} (estimated time error {:.1e})", any_model_.name,
                       mechanics::method_name(choice.method), choice.local_tolerance, choice.error);
  else
    context_.log->info("{}: {}{}, step {:.4g} (estimated time error {:.1e})", any_model_.name,
                       mechanics::method_name(choice.method), promise(choice.method), choice.step * context_.units.time,
                       choice.error);
  warn_of_round_off(choice, any_model_.name, context_);
  context_.log->debug("{}: {}", any_model_.name, choice.why);
}

}  // namespace pseudorigid::app
