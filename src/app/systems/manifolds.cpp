#include "app/systems/manifolds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "app/systems/equilibria.h"
#include "io/column_table.h"
#include "mechanics/core/field_of.h"
#include "mechanics/equilibria/manifold_starts.h"
#include "mechanics/equilibria/phase_distance.h"
#include "mechanics/methods/dormand_prince_8.h"

namespace pseudorigid::app {
namespace {

using mechanics::CriticalPoint;
using mechanics::PhaseVector;
using mechanics::Status;

/// Distances from a critical point in (q, q̇), in the scales of the system. Motions on a stable manifold, and on an
/// unstable manifold of one dimension, start at `start_along` times a basis vector of mechanics::manifold_basis. On an
/// unstable manifold of more dimensions, `start_around` is the initial size in the slowest direction (all_around in
/// mechanics/equilibria/manifold_starts.h). A motion has arrived at a point if its distance is below
/// `arrival_distance`. It has left its first point when its distance has exceeded `departure_distance`.
constexpr double start_along = 1e-5, start_around = 1e-3, arrival_distance = 1e-6, departure_distance = 1e-2;
/// Tolerance per step of the method explicit-8.
constexpr double local_tolerance = 1e-13;

/// A motion: its number, the number of the critical point on whose manifold it lies, and true for the stable manifold.
/// Both numbers count from 1.
struct Curve {
  int number, from;
  bool stable;
};

/// The end of a motion.
struct End {
  int to = 0;                     ///< number of the critical point at the end; 0 if the motion does not end at one
  double distance = 0, time = 0;  ///< distance from the nearest critical point, and internal time, at the end; the
                                  ///< first point of the motion counts only after the motion has left it
  Status step{};                  ///< status of the last step; a failure ends the motion
};

/// Columns of manifolds.csv. They are the number of the motion, the number of its critical point, 1 for a stable and 0
/// for an unstable manifold, the time, and the columns of the system.
std::vector<scene::Column> curve_columns(const std::vector<scene::Column>& of_system) {
  std::vector<scene::Column> columns{{"curve", "", ""}, {"point", "", ""}, {"stable", "", ""}, {"time", "time", ""}};
  columns.insert(columns.end(), of_system.begin(), of_system.end());
  return columns;
}

/// The motions on the manifolds of all critical points, and their two tables.
class ManifoldRun {
 public:
  ManifoldRun(const systems::AnySystemScene& system, const systems::AnyModel& model, const systems::Scales& scales,
              const RunContext& context, const std::vector<CriticalPoint>& points, ModelOutcome& outcome)
      : model_(model),
        context_(context),
        points_(points),
        landscape_(model.landscape()),
        periods_(landscape_.periods()),
        length_(context.internal_time(std::abs(context.scene.time.end))),
        rows_(context.directory.csv("manifolds"), curve_columns(system.description.columns_of(context.scene)), scales),
        ends_(context.directory.csv("connections"), connections_columns(), scales),
        outcome_(outcome) {
    if (points.empty()) return;
    const double depth = points.back().V - points.front().V;  // points are sorted by V
    if (depth > 0) highest_energy_ = points.back().V + depth;
  }

  /// Computes the motions of all critical points with an unstable manifold. Fails if a motion on an unstable manifold
  /// cannot be computed to its end, if a row cannot be computed, or after an interrupt.
  Status run() {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto unstable = mechanics::manifold_basis(points_[i], true);
      if (unstable.empty()) continue;
      const int from = static_cast<int>(i) + 1;
      const auto leaving = unstable.size() == 1
                               ? mechanics::both_ways(unstable, start_along)
                               : mechanics::all_around(unstable, context_.scene.manifolds.starts, start_around);
      if (Status status = follow_all(from, false, leaving); !status) return status;
      const auto arriving = mechanics::both_ways(mechanics::manifold_basis(points_[i], false), start_along);
      if (Status status = follow_all(from, true, arriving); !status) return status;
    }
    rows_.flush();
    ends_.flush();
    return stopped_;
  }

  int n_curves() const { return n_curves_; }

 private:
  /// Computes the motions from all starts on one manifold of the critical point with the number `from`. Writes their
  /// rows, and adds a line about their ends to the results. If a motion on an unstable manifold fails, the loop
  /// continues, and `stopped_` receives the first failure. Fails if the run is interrupted or a row cannot be computed.
  Status follow_all(int from, bool stable, const std::vector<PhaseVector>& starts) {
    std::vector<int> n_ends(points_.size() + 1, 0);
    int n_stopped = 0;
    for (const PhaseVector& start : starts) {
      if (context_.interrupted()) return Status::failure("interrupted");
      const Curve curve{++n_curves_, from, stable};
      systems::AnyModel at_rest = model_.resting_at(points_[static_cast<std::size_t>(from - 1)].q);
      End end;
      const Status status =
          std::visit([&](const auto& form) { return follow(form, at_rest, curve, start, end); }, at_rest.form());
      if (!status) return status;
      if (!end.step) {
        ++n_stopped;
        if (stopped_)
          stopped_ =
              Status::failure(fmt::format("curve {}, which leaves point {}, stops at t = {:.6g}: {}", curve.number,
                                          from, end.time * context_.units.time, end.step.reason()));
        continue;
      }
      ++n_ends[static_cast<std::size_t>(end.to)];
      ends_.append({double(curve.number), double(from), double(stable), double(end.to), end.distance, end.time});
    }
    std::string text;
    for (std::size_t to = 1; to < n_ends.size(); ++to)
      if (n_ends[to] > 0)
        text += fmt::format("{}{} {} point {}", text.empty() ? "" : ", ", n_ends[to], stable ? "from" : "to", to);
    if (n_ends[0] > 0) text += fmt::format("{}{} to no point", text.empty() ? "" : ", ", n_ends[0]);
    if (n_stopped > 0) text += fmt::format("{}{} cannot be followed", text.empty() ? "" : ", ", n_stopped);
    add_result(outcome_, context_,
               fmt::format("  point {}, {} manifold: {} motions, {}", from, stable ? "stable" : "unstable",
                           starts.size(), text));
    return {};
  }

  /// Integrates a motion from its start, backwards in time on a stable manifold. Writes its rows to manifolds.csv and
  /// sets `end`. The motion ends at a critical point, after the time |Time/End|, or when a step fails. On a stable
  /// manifold, the motion also ends if its energy exceeds `highest_energy_`. A failed step is recorded in `end.step`
  /// only on an unstable manifold. Fails if the run is interrupted, if the start cannot be projected onto the
  /// constraints, or if a row or the state at its time cannot be computed.
  template <class Form>
  Status follow(const Form& form, systems::AnyModel& at_rest, const Curve& curve, const PhaseVector& start, End& end) {
    using Method = mechanics::DormandPrince8;
    const auto& field = mechanics::field_of(form);
    using Field = std::decay_t<decltype(field)>;
    const auto& rest = at_rest.start().q;
    offset_ = points_[static_cast<std::size_t>(curve.from - 1)].q - rest;
    mechanics::State<Field> state{0, rest + start.q, start.v};
    auto system_workspace = form.make_workspace();
    Method::Workspace<Field> w(field, local_tolerance);
    if constexpr (mechanics::ProjectedField<Field>)
      if (Status status = field.project(state.q, state.v, w.system); !status) return status;
    mechanics::State<Field> between = state;
    const double t_end = curve.stable ? -length_ : length_, interval = t_end / context_.scene.output.samples;
    if (Status status = append(curve, state, at_rest, system_workspace); !status) return status;
    bool has_left = false;
    for (long k = 1; state.t != t_end;) {
      if (context_.interrupted()) return Status::failure("interrupted");
      if (Status status = Method::step(field, t_end, state, w); !status) {
        end.time = state.t;
        if (!curve.stable) end.step = std::move(status);  // backwards in time a motion can grow without bound
        break;
      }
      for (; std::abs(interval * static_cast<double>(k)) <= std::abs(state.t); ++k) {
        if (Status status = Method::interpolate(field, interval * static_cast<double>(k), between, w); !status)
          return status;
        if (Status status = append(curve, between, at_rest, system_workspace); !status) return status;
      }
      if (arrives(curve, state, has_left, end)) return {};
      if (curve.stable && energy(state) > highest_energy_) break;
    }
    end.to = 0;
    return {};
  }

  /// Returns true if the state is at a critical point. Sets `end` to the nearest critical point and the distance from
  /// it. The point at which the motion starts does not count until the motion has left it; `has_left` then becomes
  /// true.
  template <class State>
  bool arrives(const Curve& curve, const State& state, bool& has_left, End& end) {
    end = {};
    end.time = state.t;
    double least = HUGE_VAL;
    for (std::size_t j = 0; j < points_.size(); ++j) {
      const Eigen::VectorXd q = state.q + offset_;
      const double d = mechanics::phase_distance(q, state.v, points_[j].q, periods_);
      const bool is_own = static_cast<int>(j) + 1 == curve.from;
      if (is_own && d > departure_distance) has_left = true;
      if ((!is_own || has_left) && d < least) {
        least = end.distance = d;
        end.to = static_cast<int>(j) + 1;
      }
    }
    return end.to != 0 && end.distance < arrival_distance;
  }

  /// Kinetic plus potential energy of the state in internal units.
  template <class State>
  double energy(const State& state) const {
    Eigen::MatrixXd M;
    const Eigen::VectorXd q = state.q + offset_;
    landscape_.mass(q, M);
    return landscape_.potential(q) + 0.5 * state.v.dot(M * state.v);
  }

  /// Writes a row of manifolds.csv. Fails if a value cannot be computed or is not finite.
  template <class State, class Workspace>
  Status append(const Curve& curve, const State& state, systems::AnyModel& at_rest, Workspace& workspace) {
    row_.assign({double(curve.number), double(curve.from), double(curve.stable), state.t});
    if (Status status = at_rest.row({state.t, state.q, state.v}, workspace, row_); !status) return status;
    if (!rows_.append_if_finite(row_)) return Status::failure("a motion has grown beyond the range of numbers");
    return {};
  }

  const systems::AnyModel& model_;
  const RunContext& context_;
  const std::vector<CriticalPoint>& points_;
  mechanics::AnyLandscape landscape_;
  Eigen::VectorXd periods_,
      offset_;  ///< periods of the landscape's coordinates, and their offset from the coordinates of the motion
  double length_,
      highest_energy_ = HUGE_VAL;  ///< longest duration of a motion in internal time; energy above which a motion on a
                                   ///< stable manifold ends
  std::vector<double> row_;
  io::ColumnTable rows_, ends_;
  ModelOutcome& outcome_;  ///< receives the text of the results
  int n_curves_ = 0;
  Status stopped_;  ///< failure of the first motion on an unstable manifold that cannot be computed to its end
};

}  // namespace

std::vector<scene::Column> connections_columns() {
  return {{"curve", "", "number of the motion, as in manifolds.csv"},
          {"from", "", "number of the critical point whose manifold it is on, as in equilibria.csv"},
          {"stable", "", "1: on the stable manifold, followed backwards in time; 0: on the unstable one"},
          {"to", "", "number of the critical point at its other end; 0: none within Time/End"},
          {"distance", "", "distance from the nearest point at its end, in positions and rates, in the scene's units"},
          {"time", "time", "when it has come there; less than 0 on stable manifolds"}};
}

ModelOutcome run_manifolds(const systems::AnySystemScene& system, const systems::AnyModel& model,
                           const systems::Scales& scales, const RunContext& context) {
  const bool dissipative = std::visit([](const auto& form) { return mechanics::dissipative(form); }, model.form());
  mechanics::CriticalPoints found;
  ModelOutcome outcome = run_equilibria(model.landscape(), dissipative, model.coordinates(), scales, context, &found);
  if (outcome.end != mechanics::Outcome::finished) return outcome;
  ManifoldRun run(system, model, scales, context, found.points, outcome);
  if (const Status status = run.run(); !status) {
    outcome.end = context.interrupted() ? mechanics::Outcome::interrupted : mechanics::Outcome::failed;
    outcome.message = "the manifolds are not complete: " + status.reason();
  }
  outcome.statistics.counters["motions"] = run.n_curves();
  return outcome;
}

}  // namespace pseudorigid::app
