#include "app/reduced/reduced_in_lanes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "app/reduced/reduced_model.h"
#include "app/reduced/reduced_scene.h"
#include "mechanics/steps/largest_frequency.h"
#include "mechanics/steps/step_size.h"
#include "reduced/motions_in_lanes.h"

namespace pseudorigid::app {
namespace {

using reduced::n_body_lanes;
/// The method for Time/Method = auto. It needs only one force evaluation and one constraint solve per step.
using LaneMethod = mechanics::Symmetric8;

/// True if the scenes of two runs have the same law, method, tolerance, step, end and number of samples. Steps and ends
/// are compared in internal units. The shape of the body and the initial state may differ.
bool alike(const RunContext& a, const materials::AnyLaw& law_of_a, const RunContext& b,
           const materials::AnyLaw& law_of_b) {
  const auto& s = a.scene.time;
  const auto& t = b.scene.time;
  return law_of_a == law_of_b && s.method == t.method && s.tolerance == t.tolerance &&
         s.step.has_value() == t.step.has_value() &&
         (!s.step || a.internal_time(*s.step) == b.internal_time(*t.step)) &&
         a.internal_time(s.end) == b.internal_time(t.end) && a.scene.output.samples == b.scene.output.samples;
}

/// True if the body is incompressible and has no forces other than the stress of its law.
bool is_plain(const RunContext& context, const ReducedScene& s) {
  const ReducedForm form = form_of(s);
  const bool has_potential =
      form == ReducedForm::elastic || form == ReducedForm::general || form == ReducedForm::diagonal;
  return context.scene.body.incompressible && has_potential && s.forcing.gravity_constant == 0 &&
         !reduced::ExternalPotential(s.forcing).present();
}

/// The matrices of all bodies in lanes: entry i of a body, row by row, has the index i · n_body_lanes + body.
/// `matrix_of(body)` returns the matrix of one body, for example Q.
template <class MatrixOf>
reduced::MatricesInLanes in_lanes(const MatrixOf& matrix_of) {
  reduced::MatricesInLanes values;
  for (int body = 0; body < n_body_lanes; ++body) {
    const Eigen::Matrix3d matrix = matrix_of(body);
    for (int i = 0; i < 9; ++i) values[i * n_body_lanes + body] = matrix(i / 3, i % 3);
  }
  return values;
}

/// The matrix of one body from the matrices of all bodies. This function is the inverse of `in_lanes`.
Eigen::Matrix3d of_lane(const reduced::MatricesInLanes& values, int body) {
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 9; ++i) matrix(i / 3, i % 3) = values[i * n_body_lanes + body];
  return matrix;
}

/// The run of n_body_lanes = 8 bodies of the same form.
template <class Body>
class RunInLanes {
 public:
  using State = mechanics::State<Body>;

  RunInLanes(std::span<const RunContext> contexts, const std::vector<ReducedScene>& scenes, std::vector<Body> bodies)
      : contexts_(contexts),
        scenes_(scenes),
        bodies_(std::move(bodies)),
        times_{first().internal_time(first().scene.time.end), first().scene.output.samples},
        inertia_{.volume = {},
                 .E0_inverse = in_lanes([&](int i) { return scenes[i].body.E0.inverse(); }),
                 .isotropic = std::ranges::all_of(scenes, [](const ReducedScene& s) {
                   return s.body.E0.isApprox(s.body.E0(0, 0) * Eigen::Matrix3d::Identity(), 1e-14);
                 })} {
    for (int i = 0; i < n_body_lanes; ++i) inertia_.volume[i] = scenes[i].body.volume;
  }

  /// Runs the bodies and writes their rows. Returns an empty value if no step is found, if a motion fails, or if the
  /// step is not stable. Also returns an empty value if a row cannot be computed or is not finite.
  std::optional<std::vector<ModelOutcome>> run() {
    const mechanics::StepChoice choice = choose();
    if (!choice.status) return {};
    const long n_steps = times_.steps_per_interval(choice.step);
    const reduced::MotionsInLanes motions = move(choice.method, times_, n_steps);
    if (!motions.failure.empty() || !is_stable(choice, motions)) return {};

    std::vector<ModelOutcome> outcomes;
    for (int i = 0; i < n_body_lanes; ++i) {
      ModelOutcome outcome;
      if (!deliver(i, motions, outcome.statistics)) return {};
      auto& counters = outcome.statistics.counters;
      counters["steps"] = static_cast<double>(motions.counters.n_steps);
      counters["forces"] = static_cast<double>(motions.counters.n_force);
      counters["pilot_forces"] = static_cast<double>(choice.n_force);
      counters["estimated_time_error"] = choice.error;
      outcome.stepping = Stepping{choice.method, choice.step, choice.local_tolerance};
      outcomes.push_back(std::move(outcome));
    }
    return outcomes;
  }

 private:
  const RunContext& first() const { return contexts_.front(); }

  /// Integrates all bodies from their initial states with `n_steps` equal steps between two samples.
  reduced::MotionsInLanes move(mechanics::MethodId method, const mechanics::SampleTimes& times, long n_steps) const {
    return reduced::motions_in_lanes(scenes_.front().law, inertia_, in_lanes([&](int i) { return scenes_[i].start.q; }),
                                     in_lanes([&](int i) { return scenes_[i].start.v; }), method, times, n_steps);
  }

  /// The largest step of RATTLE that is stable for all bodies, multiplied by the safety factor `reserve`. `state_of(i)`
  /// returns the state of body i. Returns 0 if a frequency is not found.
  template <class StateOf>
  double rattle_limit(const StateOf& state_of, double reserve) const {
    constexpr int n_lanczos = 24;
    double limit = HUGE_VAL;
    for (int i = 0; i < n_body_lanes; ++i) {
      const State state = state_of(i);
      auto workspace = bodies_[i].make_workspace();
      const auto frequency = mechanics::largest_frequency(bodies_[i], state, workspace, n_lanczos);
      if (!frequency.status) return 0;
      limit = std::min(
          limit, mechanics::rattle_step_limit(frequency.omega, mechanics::affine_rate(state.q, state.v), reserve));
    }
    return limit;
  }

  /// The method and the step for all bodies. If the scene gives both, there is no search. Otherwise pilot runs in lanes
  /// find the step that the body with the largest error needs.
  mechanics::StepChoice choose() const {
    const auto& time = first().scene.time;
    const std::optional<mechanics::MethodId> asked = mechanics::find_method(time.method);
    const mechanics::MethodId method = asked.value_or(mechanics::id_of<LaneMethod>);
    const double bound = time.step ? first().internal_time(*time.step) : HUGE_VAL;
    if (asked && time.step) return {.method = method, .step = bound};
    mechanics::StepRequest request{.end = times_.end,
                                   .window = std::min(times_.end, pilot_window),
                                   .tolerance = time.tolerance,
                                   .rattle_limit = rattle_limit([&](int i) { return scenes_[i].start; }, 0.8),
                                   .step_bound = std::min(bound, times_.end),
                                   .interval = times_.interval(),
                                   .method = method,
                                   .give_up = [this] { return first().interrupted(); }};
    request.rattle_limit = std::min(request.rattle_limit, request.end);
    return mechanics::detail::choose_among({in_pilots(method)}, {}, true, request);
  }

  /// The method for the search: its order, its stability limit and a function that makes its pilot runs. Empty for an
  /// adaptive method.
  mechanics::detail::FixedStepMethod in_pilots(mechanics::MethodId id) const {
    return mechanics::with_method(id, [&]<class Method>(Method) -> mechanics::detail::FixedStepMethod {
      if constexpr (Method::adaptive)
        return {};
      else
        return {id, Method::order, Method::n_stages, mechanics::step_limit<Method>,
                [this, id](double window, long n_samples, long n_steps) {
                  return pilot(move(id, {window, n_samples}, n_steps));
                }};
    });
  }

  /// The result of a pilot run in the form that the search requires. One configuration contains the matrices Q of all
  /// bodies.
  static mechanics::detail::PilotRun pilot(const reduced::MotionsInLanes& motions) {
    mechanics::detail::PilotRun run;
    run.t = motions.t;
    run.n_force = motions.counters.n_force;
    if (!motions.failure.empty()) run.status = mechanics::Status::failure(motions.failure);
    for (const auto& q : motions.q) run.q.emplace_back(Eigen::Map<const Eigen::VectorXd>(q.data(), std::ssize(q)));
    for (const auto& v : motions.v)
      for (const double x : v) run.speed = std::max(run.speed, std::abs(x));
    return run;
  }

  /// True if the step is stable during the whole motion. A step below a quarter of the step limit at the start is
  /// assumed to be stable. Any other step must be at most 0.9 of the stability limit at each of 16 samples, because
  /// runs in lanes cannot reduce their step.
  bool is_stable(const mechanics::StepChoice& choice, const reduced::MotionsInLanes& motions) const {
    constexpr double much = 4, little_reserve = 0.9;
    constexpr long n_looks = 16;
    const double part = mechanics::with_method(choice.method, []<class Method>(Method) -> double {
      if constexpr (Method::adaptive)
        return 0;
      else
        return Method::stability_limit / mechanics::Rattle::stability_limit;
    });
    if (much * choice.step < part * choice.rattle_limit) return true;
    for (long look = 0; look < n_looks; ++look) {
      const auto k = static_cast<std::size_t>(look * times_.n_samples / n_looks);
      const auto state_of = [&](int i) { return State{0, of_lane(motions.q[k], i), of_lane(motions.v[k], i)}; };
      if (choice.step > part * rattle_limit(state_of, little_reserve)) return false;
    }
    return true;
  }

  /// Writes the rows of run i into its sink, and its counters into `statistics`. Returns false if a row cannot be
  /// computed or is not finite.
  bool deliver(int i, const reduced::MotionsInLanes& motions, io::Manifest::Model& statistics) const {
    const RunContext& context = contexts_[i];
    ReducedModel<Body> model(bodies_[i], scenes_[i], context);
    const auto sink = context.sink_of(context, model.name.c_str());
    sink->create(model.columns());
    auto workspace = bodies_[i].make_workspace();
    std::vector<double> row;
    for (long k = 0; k <= times_.n_samples; ++k) {
      const State state{times_[k], of_lane(motions.q[k], i), of_lane(motions.v[k], i)};
      if (!model.row(context.time_of_sample(k), state, workspace, row)) return false;
      if (!std::ranges::all_of(row, [](double x) { return std::isfinite(x); })) return false;
      sink->append(row);
    }
    model.report(motions.counters, nullptr, statistics);
    return true;
  }

  static constexpr double pilot_window = 20;  // duration of a pilot run in internal time, as in ReducedModel

  std::span<const RunContext> contexts_;
  const std::vector<ReducedScene>& scenes_;
  std::vector<Body> bodies_;
  mechanics::SampleTimes times_;
  reduced::InertiaInLanes inertia_;
};

template <ReducedForm form>
std::optional<std::vector<ModelOutcome>> run_as(std::span<const RunContext> contexts,
                                                const std::vector<ReducedScene>& scenes) {
  using Body = decltype(system_of<form, true>(scenes.front()));
  std::vector<Body> bodies;
  for (const ReducedScene& scene : scenes) bodies.push_back(system_of<form, true>(scene));
  return RunInLanes<Body>(contexts, scenes, std::move(bodies)).run();
}

}  // namespace

std::optional<std::vector<ModelOutcome>> run_reduced_in_lanes(std::span<const RunContext> contexts) {
  if (contexts.size() != n_body_lanes) return {};
  const auto method = mechanics::find_method(contexts.front().scene.time.method);
  if (method && !reduced::moves_in_lanes(*method)) return {};
  std::vector<ReducedScene> scenes;
  for (const RunContext& context : contexts) {
    scenes.push_back(reduced_scene(context.scene));
    const bool is_one_of_them = alike(context, scenes.back().law, contexts.front(), scenes.front().law);
    if (!is_one_of_them || !is_plain(context, scenes.back())) return {};
  }
  return std::holds_alternative<materials::CiarletGeymonat>(scenes.front().law)
             ? run_as<ReducedForm::elastic>(contexts, scenes)
             : run_as<ReducedForm::general>(contexts, scenes);
}

}  // namespace pseudorigid::app
