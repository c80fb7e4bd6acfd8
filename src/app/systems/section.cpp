#include "app/systems/section.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "app/run/model_stepping.h"
#include "app/systems/system_model.h"
#include "io/csv.h"
#include "io/signals.h"
#include "mechanics/core/bracketed_root.h"
#include "mechanics/core/field_of.h"
#include "mechanics/methods/dormand_prince_8.h"
#include "mechanics/steps/step_size.h"

namespace pseudorigid::app {
namespace {

using mechanics::Status;
using Method = mechanics::DormandPrince8;

/// Number of evaluations of the section's column in each step, and number of steps between two checks of the interrupt
/// flag.
constexpr int looks_per_step = 8, steps_between_interrupts = 256;
/// Local tolerance of the integration that locates a crossing. The method accepts only slightly smaller tolerances.
constexpr double tolerance_of_location = 1e-15;

/// The motion and the table of its crossings of the surface of section.
template <class Form>
class SectionRun {
  using Field = mechanics::FieldOf<Form>;
  using State = mechanics::State<Form>;

 public:
  SectionRun(const Form& form, SystemModel<Form>& motion, const RunContext& context)
      : form_(form),
        motion_(motion),
        context_(context),
        field_(mechanics::field_of(form)),
        workspace_(form.make_workspace()),
        columns_(motion.columns()),
        watched_(
            static_cast<std::size_t>(std::ranges::find(columns_, context.scene.section.column) - columns_.begin())),
        end_(context.internal_time(std::abs(context.scene.time.end))),
        csv_(io::CsvWriter::create(context.directory.csv("section"), columns_)) {}

  ModelOutcome run() {
    const auto start = std::chrono::steady_clock::now();
    ModelOutcome outcome;
    auto& counters = outcome.statistics.counters;
    typename Method::template Workspace<Field> w(field_, choose_tolerance(counters));
    if (context_.scene.time.step) w.h_max = context_.internal_time(*context_.scene.time.step);
    State state = motion_.initial_state();
    const Status status = go(state, w, outcome.end);
    csv_.flush();
    if (!status) {
      outcome.message =
          fmt::format("{} stopped at t = {:.6g}: {}", motion_.name, state.t * context_.units.time, status.reason());
    }
    counters["steps"] = static_cast<double>(w.counters.n_steps);
    counters["forces"] = static_cast<double>(w.counters.n_force);
    counters["crossings"] = static_cast<double>(csv_.n_rows());
    outcome.statistics.timers["run"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const auto& section = context_.scene.section;
    add_result(outcome, context_, fmt::format("{} crossings of {} = {}", csv_.n_rows(), section.column, section.value));
    return outcome;
  }

 private:
  /// Returns the local tolerance that Time/Tolerance requires, and adds the counters of the search. If the search
  /// fails, logs a warning and returns 1e-3 of Time/Tolerance, but at least 1e-14.
  double choose_tolerance(std::map<std::string, double>& counters) {
    const double tolerance = context_.scene.time.tolerance;
    const mechanics::StepRequest request{.end = end_,
                                         .window = motion_.pilot_window(end_),
                                         .tolerance = tolerance,
                                         .step_bound = end_,
                                         .interval = end_,
                                         .method = mechanics::id_of<Method>,
                                         .give_up = [this] { return context_.interrupted(); }};
    const auto choice = mechanics::choose_step(form_, motion_.initial_state(), request,
                                               [](const State& s) -> Eigen::MatrixXd { return s.q; });
    counters["pilot_forces"] = static_cast<double>(choice.n_force);
    if (!choice.status) {
      const double least = std::max(1e-3 * tolerance, 1e-14);
      context_.log->warn("{}: the error cannot be fitted to the tolerance ({}); local tolerance {:.1e}", motion_.name,
                         choice.status.reason(), least);
      return least;
    }
    counters["estimated_time_error"] = choice.error;
    context_.log->info("{}: {}, local tolerance {:.1e} (estimated time error {:.1e})", motion_.name, Method::name,
                       choice.local_tolerance, choice.error);
    warn_of_round_off(choice, motion_.name, context_);
    return choice.local_tolerance;
  }

  /// Integrates the motion to its end and writes a row for each crossing. Sets `end` to the outcome. Fails if a step
  /// fails, if a column cannot be computed, or after an interrupt.
  template <class Workspace>
  Status go(State& state, Workspace& w, mechanics::Outcome& end) {
    end = mechanics::Outcome::failed;
    double before = 0;
    if (Status status = level(state, before); !status) return status;
    State between = state, start = state;
    while (state.t < end_) {
      start = state;
      if (Status status = Method::step(field_, end_, state, w); !status) return status;
      ++w.counters.n_steps;
      double early = start.t;
      for (int i = 1; i <= looks_per_step; ++i) {
        const double late = i == looks_per_step ? state.t : start.t + (state.t - start.t) * i / looks_per_step;
        if (Status status = Method::interpolate(field_, late, between, w); !status) return status;
        double after = 0;
        if (Status status = level(between, after); !status) return status;
        if (Status status = take(start, early, late, before, after); !status) return status;
        // If the motion starts on the surface, `before` is 0 at first, and the start is not a crossing.
        before = after;
        early = late;
      }
      if (w.counters.n_steps % steps_between_interrupts == 0 && context_.interrupted()) {
        end = mechanics::Outcome::interrupted;
        return Status::failure("interrupted");
      }
    }
    end = mechanics::Outcome::finished;
    return {};
  }

  /// Sets `distance` to the value of the section's column minus the value of the section, in the user's units. If the
  /// section has a period, subtracts the multiple of the period for which |distance| is least. `row_` then has the
  /// columns of the state. Fails if a column cannot be computed or is not finite.
  Status level(const State& state, double& distance) {
    if (Status status = motion_.row(state.t * context_.units.time, state, workspace_, row_); !status) return status;
    if (!std::all_of(row_.begin(), row_.end(), [](double x) { return std::isfinite(x); }))
      return Status::failure("the motion has grown beyond the range of numbers");
    const auto& section = context_.scene.section;
    distance = row_[watched_] - section.value;
    if (section.period > 0) distance = std::remainder(distance, section.period);
    return {};
  }

  /// True if the change of sign between the distances `before` and `after` is a crossing in a direction that the scene
  /// requests.
  bool counts(double before, double after) const {
    const scene::Crossings wanted = context_.scene.section.crossings;
    const bool rises = before < 0 && after >= 0, falls = before > 0 && after <= 0;
    return (rises && wanted != scene::Crossings::down) || (falls && wanted != scene::Crossings::up);
  }

  /// Locates the crossing between the times `early` and `late` within the step from `start`, and writes a row for it.
  /// `before` and `after` are the distances at these times. Writes nothing if there is no crossing, or if the column
  /// jumps. Fails if a step fails or a column cannot be computed.
  Status take(const State& start, double early, double late, double before, double after) {
    if (!counts(before, after)) return {};
    Status status;
    State at = start;
    const auto level_after = [&](double s) {
      double distance = std::nan("");
      at = start;
      typename Method::template Workspace<Field> local(field_, tolerance_of_location);
      while (status && at.t < start.t + s) status = Method::step(field_, start.t + s, at, local);
      if (status) status = level(at, distance);
      return distance;
    };
    const auto crossing = mechanics::bracketed_root(level_after, early - start.t, late - start.t);
    if (!status) return status;
    if (!crossing) return {};  // only the dense output crosses the surface, because of round-off
    const double distance = std::abs(level_after(*crossing));
    if (!status) return status;
    const bool jumps = distance > 1e-3 * (std::abs(before) + std::abs(after)) && distance > 1e-9;
    if (!jumps) csv_.append(row_);
    return {};
  }

  const Form& form_;
  SystemModel<Form>& motion_;
  const RunContext& context_;
  decltype(mechanics::field_of(std::declval<const Form&>())) field_;
  typename Form::Workspace workspace_;
  const std::vector<std::string> columns_;
  std::size_t watched_;  ///< index of the column that defines the surface
  double end_;           ///< duration of the motion in internal time
  io::CsvWriter csv_;
  std::vector<double> row_;  ///< columns of the state in the last call of `level`
};

}  // namespace

ModelOutcome run_section(const systems::AnySystemScene& system, systems::AnyModel& model, const systems::Scales& scales,
                         const RunContext& context) {
  return std::visit(
      [&]<class Form>(const Form& form) {
        SystemModel motion(system.description, form, model, scales, context.scene);
        return SectionRun<Form>(form, motion, context).run();
      },
      model.form());
}

}  // namespace pseudorigid::app
