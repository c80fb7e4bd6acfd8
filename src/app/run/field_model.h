#pragma once
/// Base class of the two models whose displacement need not be affine: the finite-element model and the polynomial
/// model.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/run/contact_watch.h"
#include "app/run/deformation_trace.h"
#include "app/run/flight.h"
#include "app/run/no_start.h"
#include "app/run/nonaffine_watch.h"
#include "app/run/orbit_of_run.h"
#include "app/run/runnable_model.h"
#include "app/run/scene_to_model.h"
#include "app/run/tension_watch.h"
#include "io/trajectory.h"
#include "mechanics/core/explicit_multiplier.h"
#include "mechanics/core/shape_columns.h"
#include "mechanics/steps/step_size.h"

namespace pseudorigid::app {

/// Common part of both models. S is the type of the system. `Faces` computes the shapes for the report. It is
/// continuum::MaterialFaces or polynomial::MaterialFaces.
template <class S, class Faces>
class FieldModel : public RunnableModelOf<S> {
  using Base = RunnableModelOf<S>;
  /// Factor of the tolerance in the search for the step. A pilot run covers only the first part of the motion. After
  /// the release of a deformed body, the time error grows in this part at only 0.45 of its mean rate over the run. This
  /// was measured at Time/Tolerance = 1e-3 and 1e-4 until t = 10.
  static constexpr double reserve = 0.4;

 public:
  using typename Base::State, typename Base::Workspace;
  using Vector = typename S::Vector;

  State initial_state() const final {
    const scene::Scene& scene = context_.scene;
    const io::Units& units = context_.units;
    State state{0, affine(initial_deformation(scene), initial_center(scene, units)),
                affine(initial_velocity(scene, units), initial_center_velocity(scene, units))};
    if (scene.initial_state.origin && scene.initial_state.figure == scene::StartingFigure::own) put_own_figure(state);
    if (context_.needs.orbit) {
      this->system().set_companions(this->system().orbit().position(), state.q);
      this->system().set_companions(this->system().orbit().velocity(), state.v);
    }
    const loads::Branches branches = loads::constant_forcing(internal_loads(scene)).branches;
    if (!branches.empty()) this->system().start_branches(branches.relaxed, state.q);
    return state;
  }
  double constraint_scale() const final {
    if constexpr (mechanics::unconstrained<S>)
      return 1;
    else
      return this->system().multiplier_scale();
  }
  /// The matrix Q of the affine part of the positions. If the scene has companions, their scaled positions relative to
  /// the body are further columns (with_companions). If the scene has contact planes but no companions, the centre of
  /// mass is a fourth column.
  Eigen::MatrixXd configuration(const State& state) const final {
    if (context_.needs.orbit)
      return with_companions(affine_part(state.q), this->system().orbit(), this->system().companions(state.q));
    if (!context_.needs.contact) return affine_part(state.q);
    Eigen::MatrixXd configuration(3, 4);
    configuration << affine_part(state.q), mean(state.q);
    return configuration;
  }
  /// With companions, moves them to their motion shortly before the closest approach. With contact planes, moves the
  /// body to the end of its flight to the first contact (flight.h). Otherwise returns `state`.
  State start_of_pilot(const State& state) const final {
    State start = state;
    if (context_.needs.orbit) {
      const auto motion = near_pericentre(this->system().orbit());
      this->system().set_companions(motion.s, start.q);
      this->system().set_companions(motion.sdot, start.v);
      return start;
    }
    if (!context_.needs.contact) return start;
    const loads::Forcing forcing = loads::full_forcing(internal_loads(context_.scene));
    if (const auto flight = flight_to_contact(this->system().contact(state.t, state.q), mean(state.v), forcing)) {
      mechanics::axpy(1.0, affine(Eigen::Matrix3d::Zero(), flight->displacement), start.q);
      mechanics::axpy(1.0, affine(Eigen::Matrix3d::Zero(), flight->velocity_change), start.v);
    }
    return start;
  }
  /// The body without velocity, pressed into the nearest plane by the estimated depth of its first contact
  /// (depth_of_contact in flight.h).
  State in_contact(const State& state) const final {
    State pressed = start_of_pilot(state);
    const loads::Contact now = this->system().contact(pressed.t, pressed.q);
    const loads::Forcing loads = loads::full_forcing(internal_loads(context_.scene));
    const double depth = depth_of_contact(now, mean(pressed.v), loads);
    mechanics::axpy(-(now.height + depth), affine(Eigen::Matrix3d::Zero(), now.normal), pressed.q);
    mechanics::scale(0.0, pressed.v);
    return pressed;
  }
  double rate(const State& state) const final {
    return mechanics::affine_rate(affine_part(state.q), affine_part(state.v));
  }
  State at_rest(const State& state) const final {
    State rest{state.t, affine(Eigen::Matrix3d::Identity(), mean(state.q)),
               affine(Eigen::Matrix3d::Zero(), Eigen::Vector3d::Zero())};
    if (context_.needs.orbit) this->system().set_companions(this->system().companions(state.q), rest.q);
    if (mechanics::relaxes(this->system())) this->system().start_branches(false, rest.q);
    return rest;
  }
  double least_jacobian(const State& state) const final { return least_jacobian_at(state.q); }
  /// True if the least det F at q + h v and at q − h v exceeds half of its value at q. Here q are the positions, v the
  /// velocities and F the deformation gradient. The positions q ± h v approximate those after a step h forwards and a
  /// step h backwards. Collective.
  bool keeps_volume(const State& state, double h) const final {
    const double most_change = 0.5, bound = (1 - most_change) * least_jacobian_at(state.q);
    Vector x = state.q;
    for (const double time : {h, -2 * h}) {  // x + h v, then x − h v
      mechanics::axpy(time, state.v, x);
      if (!(least_jacobian_at(x) > bound)) return false;
    }
    return true;
  }
  /// Length of the pilot runs in internal time, at most `end`. It is the rise time of the loads plus a length that
  /// depends on the scene. This length is 10 if a force depends on time. Otherwise it is 3 with contact planes and 1
  /// without. For an elastic ball without self-gravity, the shear front from the surface reaches the centre at t = 1,
  /// after 0.4 periods of the slowest mode. A contact of a fast body can take up to three times as long. A force that
  /// depends on time can act later, so the length is then about four periods.
  double pilot_window(double end) const final {
    const double window = mechanics::time_dependent(this->system()) ? 10.0 : context_.needs.contact ? 3.0 : 1.0;
    return std::min(end, window + rise_time(context_.scene));
  }
  std::vector<std::string> columns() const final { return trajectory_.names(); }

  mechanics::Status row(double time, const State& state, Workspace& workspace, std::vector<double>& row) override {
    if (auto status = observe(this->system(), state, workspace, request_, observables_); !status) return status;
    if (request_.vibration) observables_.vibration = vibration(state, observables_);
    // `judge` is called after steps only. This call records a contact that exists at the start.
    if (context_.needs.contact && state.t == 0)
      contacts_.look(0, this->system().contact(state.t, state.q), mean(state.v));
    contacts_.write(observables_.contact);
    trajectory_.row(time, observables_, row);
    if (trace_) (*trace_)[sample_at(time)] = affine_part(state.q);
    nonaffine_.look(time, observables_.nonaffine_displacement);
    tension_.look(time, observables_.multiplier * context_.units.multiplier());
    return {};
  }
  void take_up(const io::Table& rows) final {
    tension_.take_up(rows);
    if (!trace_ || !rows.has_column("Q11")) return;
    const std::size_t first = rows.column_index("Q11");
    for (std::size_t n = 0; n < rows.n_rows(); ++n)
      (*trace_)[sample_at(rows.row(n)[0])] = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>(rows.row(n).data() + first);
  }
  /// Numbers for a checkpoint: three of NonaffineWatch, three of the derived class, and those of ContactWatch if the
  /// scene has contact planes.
  std::vector<double> remarks() const final {
    std::vector<double> remarks;
    for (const auto& part : {nonaffine_.remarks(), own_remarks()})
      remarks.insert(remarks.end(), part.begin(), part.end());
    const auto of_contacts = contacts_.numbers();
    if (context_.needs.contact) remarks.insert(remarks.end(), of_contacts.begin(), of_contacts.end());
    return remarks;
  }
  void take_remarks(std::span<const double> remarks) final {
    nonaffine_.take_remarks(remarks.first<3>());
    take_own_remarks(remarks.subspan<3, 3>());
    if (context_.needs.contact) contacts_.take_numbers(remarks.subspan<6, ContactWatch::n_numbers>());
  }
  /// Without companions, records the contact at the end of a step and does not fail. With companions, fails after a
  /// collision, or after a disruption of a fluid body (orbit_of_run.h). Collective.
  mechanics::Status judge(const State& state) final {
    if (context_.needs.orbit) {
      const mechanics::Orbit& orbit = this->system().orbit();
      const Eigen::Matrix3d moment = this->system().second_moment(state.q);
      return collisions_.look(state.t, orbit, moment, this->system().companions(state.q), [&] {
        if (!scene::is_fluid(context_.scene)) return -1.0;
        return own_energy(orbit, moment, affine_part(state.q), affine_part(state.v));
      });
    }
    if (context_.needs.contact) contacts_.look(state.t, this->system().contact(state.t, state.q), mean(state.v));
    return {};
  }

  std::vector<std::string> shape_columns() const final {
    std::vector<std::string> columns{"time"};
    columns.insert(columns.end(), mechanics::shape_columns.begin(), mechanics::shape_columns.end());
    return columns;
  }
  /// The rows of the table of shapes: the time, and then the shape columns with lengths in the user's units. Ranks
  /// other than the first return no rows. Collective.
  std::vector<std::vector<double>> shape(double time, const State& state) const final {
    if (!faces_) faces_.emplace(this->system().space());
    std::vector<std::vector<double>> rows = faces_->rows(state.q);
    for (std::vector<double>& row : rows) {
      for (std::size_t c = mechanics::first_length_of_shapes; c < row.size(); ++c) row[c] *= context_.units.length;
      row.insert(row.begin(), time);
    }
    return rows;
  }

  void report(const mechanics::Counters&, const Workspace*, io::Manifest::Model& statistics) const override {
    nonaffine_.report(statistics);
    tension_.report(statistics);
  }

 protected:
  FieldModel(const RunContext& context, std::string name, int steps_between_looks, DeformationTrace* trace)
      : Base(std::move(name), steps_between_looks, reserve),
        context_(context),
        trace_(trace),
        trajectory_(context.needs.quantities, context.units),
        request_(trajectory_.request()),
        nonaffine_(context, this->name),
        tension_(context, this->name) {
    request_.nonaffine |= nonaffine_.watches();
    request_.multiplier |= tension_.watches();
    request_.energies |= request_.vibration;
  }

  /// The field c + A X of positions or of velocities, with the reference position X.
  virtual Vector affine(const Eigen::Matrix3d& A, const Eigen::Vector3d& c) const = 0;
  /// Sets x and v to the positions and velocities of the model's own figure (app/figures/figure_start.h), with the
  /// small motion of the scene. Both vectors must be 0 before the call. Fails if the model does not have the figure or
  /// the small motion. Collective.
  virtual mechanics::Status own_figure(Vector& x, Vector& v) const = 0;
  /// Replaces the field x by D x.
  virtual void transform(const Eigen::Matrix3d& D, Vector& x) const = 0;
  /// The matrix Q of the affine motion that is nearest to the field in the mean square over the mass. Collective.
  virtual Eigen::Matrix3d affine_part(const Vector& x) const = 0;
  /// The mean of the field over the mass: the centre of mass, or its velocity. Collective.
  virtual Eigen::Vector3d mean(const Vector& x) const = 0;
  /// Least det F over the quadrature points, with the deformation gradient F. Collective.
  virtual double least_jacobian_at(const Vector& x) const = 0;
  /// The observables of the energy of vibration. `known` has the other observables of the same state. Collective.
  virtual mechanics::VibrationObservables vibration(const State& state,
                                                    const mechanics::ContinuumObservables& known) = 0;
  /// Three numbers of the derived class for checkpoints (RunnableModel::remarks).
  virtual std::array<double, 3> own_remarks() const = 0;
  virtual void take_own_remarks(std::span<const double, 3> remarks) = 0;

  const RunContext& context_;

 private:
  /// Replaces the positions and velocities of the body in `state` by those of its own figure,
  ///
  ///   x = x_c + D φ,   v = v_c + D φ' + V X,
  ///
  /// with the positions φ of the figure and its velocities φ'. D and V are the entries Deformation and Velocity of
  /// Initial state, and x_c is the centre of mass with the velocity v_c. A small motion (Initial state/Mode) changes
  /// the volume to second order of its amplitude. V may change the volume if the figure is not affine. The state is
  /// therefore projected onto the constraint. Throws NoStart if the model does not have the figure or the small motion.
  void put_own_figure(State& state) const {
    const scene::Scene::InitialState& start = context_.scene.initial_state;
    const Eigen::Vector3d none = Eigen::Vector3d::Zero();
    if (!own_figure_) {
      own_figure_.emplace(affine(Eigen::Matrix3d::Zero(), none), affine(Eigen::Matrix3d::Zero(), none));
      if (const auto status = own_figure(own_figure_->first, own_figure_->second); !status)
        throw NoStart(this->name + " stopped at t = 0: " + status.reason());
    }
    const Eigen::Matrix3d D = to_eigen(start.origin->deformation),
                          V = to_eigen(start.origin->velocity) * context_.units.time;
    auto [x, v] = *own_figure_;
    transform(D, x);
    transform(D, v);
    state.q = affine(Eigen::Matrix3d::Zero(), initial_center(context_.scene, context_.units));
    state.v = affine(V, initial_center_velocity(context_.scene, context_.units));
    mechanics::axpy(1.0, x, state.q);
    mechanics::axpy(1.0, v, state.v);
    const mechanics::ExplicitMultiplier<S> field(this->system());
    auto workspace = field.make_workspace();
    if (const auto status = field.project(state.q, state.v, workspace); !status)
      throw NoStart(this->name +
                    " stopped at t = 0: Initial state/Figure: the volume is not restored: " + status.reason());
  }
  /// The motion of the companions at the start of a pilot run. It is the last motion that is at least half a pilot run
  /// ahead of the closest approach to the body. If there is no such motion, it is their motion at the start of the run.
  /// It is also the motion at the start if the closest approach exceeds 0.9 of the least distance at the start
  /// (Orbit::near_closest_approach).
  mechanics::Orbit::Motion near_pericentre(const mechanics::Orbit& orbit) const {
    const double end = context_.internal_time(context_.scene.time.end);
    return orbit.near_closest_approach(end, pilot_window(end) / 2);
  }
  /// The number of the sample at a time in the user's units.
  long sample_at(double time) const {
    return std::lround(time / context_.scene.time.end * static_cast<double>(context_.scene.output.samples));
  }

  DeformationTrace* trace_;  ///< receives the affine part Q at each sample; null if this is not requested
  io::Trajectory<mechanics::ContinuumObservables> trajectory_;
  mechanics::ObservableRequest request_;
  mechanics::ContinuumObservables observables_;
  NonaffineWatch nonaffine_;
  TensionWatch tension_;
  ContactWatch contacts_;
  CollisionWatch collisions_;
  mutable std::optional<std::pair<Vector, Vector>> own_figure_;  ///< φ and φ'; empty if not needed yet
  mutable std::optional<Faces> faces_;                           ///< makes shapes; empty until the first shape
};

}  // namespace pseudorigid::app
