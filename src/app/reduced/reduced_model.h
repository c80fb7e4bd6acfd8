#pragma once
/// The pseudo-rigid body x = QX of a scene, in one of its forms (reduced_scene.h), as a model that ModelRun can
/// integrate. Here X is the reference position, and x is the position relative to the centre of mass.

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "app/reduced/reduced_scene.h"
#include "app/run/contact_watch.h"
#include "app/run/flight.h"
#include "app/run/orbit_of_run.h"
#include "app/run/picture.h"
#include "app/run/run_context.h"
#include "app/run/runnable_model.h"
#include "app/run/scene_to_model.h"
#include "app/run/tension_watch.h"
#include "io/ball_blocks.h"
#include "io/trajectory.h"
#include "mechanics/core/orbiting_system.h"
#include "mechanics/core/principal_axes.h"
#include "mechanics/steps/step_size.h"
#include "reduced/observe.h"
#include "scene/scales.h"

namespace pseudorigid::app {

/// The pseudo-rigid model. `BodySystem` is the type of the system of one form of the body (`system_of`).
template <class BodySystem>
class ReducedModel final : public RunnableModelOf<BodySystem> {
  using Base = RunnableModelOf<BodySystem>;
  /// Number of steps between two checks of the clock and of the interrupt flag. A step takes less than 1 µs, so a check
  /// after every step would cost too much time.
  static constexpr int between_looks = 256;

 public:
  using System = BodySystem;
  using typename Base::State, typename Base::Workspace;

  ReducedModel(System system, const ReducedScene& scene, const RunContext& context, std::string name = "reduced")
      : Base(std::move(name), between_looks, 1),
        system_(std::move(system)),
        center_(scene.center),
        drag_on_center_(scene.dissipation.drag != 0),
        center_is_driven_(loads::depend_on_time(scene.loads)),
        law_(scene.law),
        start_(start_of(system_, scene)),
        context_(context),
        trajectory_(context.needs.quantities, context.units),
        request_(trajectory_.request()),
        tension_(context, this->name) {
    request_.multiplier = request_.multiplier || (tension_.watches() && !mechanics::unconstrained<System>);
  }

  const System& system() const override { return system_; }
  State initial_state() const override { return start_; }
  /// The matrix Q. If the scene has contact planes, the centre of mass is a fourth column. If the scene has companions
  /// but no contact planes, their scaled positions relative to the body are further columns (with_companions).
  Eigen::MatrixXd configuration(const State& state) const override {
    if constexpr (is_loaded) {
      if (system_.has_contact()) return state.q.template leftCols<4>();
      if (mechanics::has_companions(system_))
        return with_companions(Q_of(state), system_.orbit(), system_.companions(state.q));
    }
    return Q_of(state);
  }
  State start_of_pilot(const State& state) const override {
    State start = state;
    if constexpr (is_loaded) {
      if (mechanics::has_companions(system_)) {
        const double end = context_.internal_time(context_.scene.time.end);
        start = system_.with_companions(start, system_.orbit().near_closest_approach(end, pilot_window(end) / 2));
      }
      if (!system_.has_contact()) return start;
      if (const auto flight = flight_to_contact(system_.contact(state.t, state.q), System::center(state.v),
                                                loads::full_forcing(internal_loads(context_.scene)))) {
        start.q.col(3) += flight->displacement;
        start.v.col(3) += flight->velocity_change;
      }
    }
    return start;
  }
  State in_contact(const State& state) const override {
    State pressed = start_of_pilot(state);
    if constexpr (is_loaded) {
      if (!system_.has_contact()) return pressed;
      const loads::Contact now = system_.contact(pressed.t, pressed.q);
      const loads::Forcing loads = loads::full_forcing(internal_loads(context_.scene));
      const double depth = depth_of_contact(now, System::center(pressed.v), loads);
      pressed.q.col(3) -= (now.height + depth) * now.normal;
      pressed.v.setZero();
    }
    return pressed;
  }
  double rate(const State& state) const override {
    const auto motion = system_.motion(state);
    return mechanics::affine_rate(motion.q, motion.v);
  }
  /// About ten periods of the slowest pulsation after the rise of the loads, in internal time, but at most `end`. After
  /// this time the time error of regular motions grows linearly.
  double pilot_window(double end) const override { return std::min(end, 20.0 + rise_time(context_.scene)); }

  std::vector<std::string> columns() const override { return trajectory_.names(); }

  mechanics::Status row(double time, const State& state, Workspace& workspace, std::vector<double>& row) override {
    if (auto status = check_size(state); !status) return status;
    if (auto status = system_.body().admissible(system_.motion(state).q); !status) return status;
    if (auto status = reduced::observe(system_, state, workspace, request_, observables_); !status) return status;
    if (request_.bipolar)
      if (auto status = reduced::observe_bipolar(system_, state, workspace, bipolar_, observables_); !status)
        return status;
    if (auto status = add_center_of_mass(state); !status) return status;
    // `judge` is called after steps only. This call records a contact that exists at the start.
    if (state.t == 0) look_at_contact(state);
    if (on_planes()) contacts_.write(observables_.contact);
    tension_.look(time, observables_.multiplier * context_.units.multiplier());
    note_motion(Q_of(state));
    trajectory_.row(time, observables_, row);
    return {};
  }

  /// Records the contact after a step. Fails after a collision or a disruption (orbit_of_run.h). If the body can change
  /// its volume, also checks the least singular value of Q. This value is the distance of Q from the nearest singular
  /// matrix (Eckart and Young). If this value is at most Time/Tolerance, which bounds the error of Q, the exact motion
  /// may already have collapsed. The function then fails.
  mechanics::Status judge(const State& state) override {
    look_at_contact(state);
    const Eigen::Matrix3d Q = Q_of(state);
    if (auto status = look_at_orbit(state, Q); !status) return status;
    if constexpr (!mechanics::unconstrained<System>) return {};
    const double tolerance = context_.scene.time.tolerance;
    // Because det Q = σ₁σ₂σ₃ and σ₁σ₂ ≤ |Q|²/2, the least singular value σ₃ is at least 2 det Q/|Q|². In most steps,
    // this bound suffices.
    if (2 * Q.determinant() > tolerance * Q.squaredNorm()) return {};
    const double least = mechanics::principal_axes(Q).a.minCoeff();
    if (least > tolerance) return {};
    return mechanics::Status::failure(
        fmt::format("the body collapses: its least stretch, {:.2g}, is within the error of Q that Time/Tolerance "
                    "allows, {:.2g}, so the motion after it is unknown; a smaller tolerance follows the motion further",
                    least, tolerance));
  }

  void take_up(const io::Table& rows) override {
    const auto row = rows.row(rows.n_rows() - 1);
    if (request_.bipolar) {
      bipolar_.emplace();
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const std::string place{static_cast<char>('1' + i), static_cast<char>('1' + j)};
          bipolar_->T(i, j) = row[rows.column_index("T" + place)];
          bipolar_->S(i, j) = row[rows.column_index("S" + place)];
        }
    }
    knows_motion_ = rows.has_column("Q11");
    if (knows_motion_)
      for (std::size_t n = 0; n < rows.n_rows(); ++n)
        note_motion(Eigen::Matrix<double, 3, 3, Eigen::RowMajor>(rows.row(n).data() + rows.column_index("Q11")));
    tension_.take_up(rows);
  }

  std::vector<double> remarks() const override {
    if (!on_planes()) return {};
    const auto numbers = contacts_.numbers();
    return {numbers.begin(), numbers.end()};
  }
  void take_remarks(std::span<const double> remarks) override {
    if (on_planes()) contacts_.take_numbers(remarks.first<ContactWatch::n_numbers>());
  }

  mechanics::Status write_frame(const std::filesystem::path& path, double time, const State& state,
                                Workspace& workspace) override {
    double Lambda = 0;
    if constexpr (!mechanics::unconstrained<System>)
      if (auto status = mechanics::multiplier_of_motion(system_, state, workspace, Lambda); !status) return status;
    if (!ball_) ball_ = io::ball_blocks(4, 2);  // if the blocks are cut into cells, a quarter of a circle has 8 edges
    write_picture(context_, path, time, ball_->blocks, fields(state, Lambda));
    return {};
  }

  void report(const mechanics::Counters&, const Workspace*, io::Manifest::Model& statistics) const override {
    tension_.report(statistics);
    warn_of_resolution(statistics);
  }

 private:
  /// True for the form `loaded`, the only form with contact planes and companions.
  static constexpr bool is_loaded = requires(const System& s) { s.orbit(); };
  /// True if the scene has contact planes. The centre of mass is then a part of the state.
  bool on_planes() const {
    if constexpr (is_loaded) return system_.has_contact();
    return false;
  }
  /// Fails after a collision with a companion or a disruption of a fluid body. Does nothing without companions.
  mechanics::Status look_at_orbit(const State& state, const Eigen::Matrix3d& Q) {
    if constexpr (is_loaded)
      if (mechanics::has_companions(system_)) {
        const Eigen::Matrix3d S = Q * system_.body().E0() * Q.transpose();
        const auto energy_of_body = [&] {
          if (!scene::is_fluid(context_.scene)) return -1.0;
          return own_energy(system_.orbit(), S, Q, system_.motion(state).v);
        };
        return collisions_.look(state.t, system_.orbit(), S, system_.companions(state.q), energy_of_body);
      }
    return {};
  }
  /// Records the contact. Does nothing if the scene has no contact planes.
  void look_at_contact(const State& state) {
    if constexpr (is_loaded)
      if (on_planes()) contacts_.look(state.t, system_.contact(state.t, state.q), System::center(state.v));
  }

  Eigen::Matrix3d Q_of(const State& state) const { return system_.motion(state).q; }
  /// The motion of the centre of mass. With contact planes, it is a part of the state. Otherwise it is computed
  /// separately, because it does not depend on Q.
  reduced::CenterOfMass::Motion center_at(const State& state) {
    if constexpr (is_loaded)
      if (on_planes()) return {System::center(state.q), System::center(state.v)};
    return center_.at(state.t);
  }

  /// The fields for a picture, in internal units. All fields except positions and velocities are uniform in the body.
  /// Lambda is the multiplier of the volume constraint det Q = 1; it is 0 without this constraint.
  mechanics::BodyFields fields(const State& state, double Lambda) {
    const auto& body = system_.body();
    const auto motion = system_.motion(state);
    const Eigen::Matrix3d &Q = motion.q, &Qdot = motion.v;
    const auto center = center_at(state);
    Eigen::Matrix3d stress = body.cauchy_stress(Q, Lambda / body.m_bar());
    double energy = std::visit([&](const auto& law) { return law.energy(materials::to_tensor(Q)); }, law_);
    if constexpr (is_loaded) {
      stress += system_.stress_of_branches(state.q) * Q.transpose() / Q.determinant();
      energy += system_.energy_of_branches(state.q) / body.reference().volume;
    }
    mechanics::BodyFields fields;
    fields.center = center.x;
    fields.moment = Q * body.E0();
    for (const Eigen::Vector3d& direction : ball_->points) {
      const Eigen::Vector3d X = body.reference().shape * direction;
      fields.add(X, center.x + Q * X, center.v + Qdot * X, Q, stress, energy);
    }
    return fields;
  }

  /// Updates `motion_`, the largest entry of |Q − Q₀|, and `size_`, the largest entry of |Q|, with the initial value
  /// Q₀.
  void note_motion(const Eigen::Matrix3d& Q) {
    ++n_noted_;
    motion_ = std::max(motion_, (Q - Q_of(start_)).cwiseAbs().maxCoeff());
    size_ = std::max(size_, Q.cwiseAbs().maxCoeff());
  }

  /// Warns if no entry of Q changes by more than ten times its error, because velocities and energies are then not
  /// resolved. Does not warn about a body at rest in equilibrium, for fewer than two samples, or if earlier samples of
  /// Q are not known.
  void warn_of_resolution(const io::Manifest::Model& statistics) const {
    if (!knows_motion_ || n_noted_ < 2) return;
    constexpr double well_above = 10, epsilon = std::numeric_limits<double>::epsilon();
    const auto estimate = statistics.counters.find("estimated_time_error");
    const double error = std::max(epsilon * size_, estimate == statistics.counters.end() ? 0 : estimate->second);
    // A body at rest in equilibrium moves by round-off alone. This motion is correct and needs no warning.
    const double round_off = 16 * epsilon * size_;
    const bool rests = start_.v.isZero(0) && motion_ <= round_off;
    if (rests || motion_ > well_above * error) return;
    context_.log->warn(
        "{}: Q moves by no more than {:.2g}, and its error is about {:.2g}: velocities and energies of this "
        "motion are not resolved; {}",
        this->name, motion_, error,
        motion_ > well_above * round_off ? "give a smaller Time/Tolerance" : "they are lost in round-off");
  }

  /// Fails if an entry of Q is larger than 1e12, the limit for an initial state (scene/initial_state.h).
  static mechanics::Status check_size(const State& state) {
    constexpr double largest_stretch = 1e12;
    if (System::matrix(state.q).cwiseAbs().maxCoeff() <= largest_stretch) return {};
    return mechanics::Status::failure("the body is stretched more than 1e12 times, which numbers do not resolve");
  }

  /// Adds the position, velocity and energies of the centre of mass to the observables. With drag, the energy that the
  /// centre of mass has lost counts as dissipated. With contact planes, the energies of the system already contain the
  /// energies of time-dependent loads and of drag. Fails if the motion of the centre of mass is not finite.
  mechanics::Status add_center_of_mass(const State& state) {
    const double t = state.t;
    const auto motion = center_at(state);
    if (!motion.x.allFinite() || !motion.v.allFinite())
      return mechanics::Status::failure("the external potential has carried the centre of mass beyond all numbers");
    const double mass = system_.body().reference().mass;
    observables_.center = motion.x;
    observables_.velocity = motion.v;
    const reduced::CenterOfMass& law = center_.law();
    observables_.kinetic += mass * law.kinetic(motion);
    observables_.external += mass * law.potential(motion);
    if (on_planes()) return {};  // the energies of the system contain the other terms
    if (center_is_driven_) observables_.external += mass * law.driven(motion, t);
    if (drag_on_center_) {
      const reduced::CenterOfMass::Motion start{law.position, law.velocity};
      double lost = law.kinetic(start) + law.potential(start) - law.kinetic(motion) - law.potential(motion);
      if (center_is_driven_) lost += law.driven(start, 0) - law.driven(motion, t);
      observables_.dissipated += mass * lost;
    }
    return {};
  }

  System system_;
  reduced::CenterPath center_;
  bool drag_on_center_, center_is_driven_;  ///< whether drag, and loads that depend on time, act on the body
  materials::AnyLaw law_;
  State start_;
  const RunContext& context_;
  io::Trajectory<mechanics::ReducedObservables> trajectory_;
  mechanics::ObservableRequest request_;
  TensionWatch tension_;
  double motion_ = 0, size_ = 0;  ///< largest entries of |Q − Q₀| and |Q| at the samples
  bool knows_motion_ = true;      ///< false if a resumed run has earlier rows without Q
  long n_noted_ = 0;              ///< number of samples that were recorded in `motion_` and `size_`
  mechanics::ReducedObservables observables_;
  ContactWatch contacts_;
  CollisionWatch collisions_;
  std::optional<reduced::Bipolar> bipolar_;  ///< decomposition Q = TᵀAS at the last sample; empty before the first one
  std::optional<io::BallBlocks> ball_;       ///< blocks of the pictures; empty until the first picture
};

}  // namespace pseudorigid::app
