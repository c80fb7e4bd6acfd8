#pragma once
/// The pseudo-rigid body whose energy is not constant: M Q̈ = f − ∂R/∂Q̇ − ∂V_t/∂Q + Gᵀλ, with the mass operator M,
/// which maps Q̈ to Q̈ E₀. Here f and Gᵀλ are the force and the reaction of the conservative body, and R is Rayleigh's
/// function (dissipation.h). V_t(Q, t) is the energy of the loads that depend on time. The dissipated energy D and the
/// energy W that these loads have given are integrated with the motion:
///
///   Ḋ = 2R(Q, Q̇),   Ẇ = ∂V_t/∂t.
///
/// D and W are the velocities of further coordinates s and s' of unit mass, with s̈ = 2R and s̈' = ∂V_t/∂t. Therefore
/// every method integrates the energies with its own order. The vectors are q = [Q | (s, s', 0)ᵀ] and v = [Q̇ | (D, W,
/// 0)ᵀ].

#include "loads/list.h"
#include "mechanics/core/constrained_system.h"
#include "mechanics/core/linearization.h"
#include "mechanics/core/second_order_field.h"
#include "reduced/body_of_stages.h"
#include "reduced/dissipation.h"
#include "reduced/external_potential.h"

namespace pseudorigid::reduced {

template <class Body>
class DissipativeBody {
 public:
  using Vector = Eigen::Matrix<double, 3, 4>;
  using Multiplier = typename Body::Multiplier;
  using Workspace = typename Body::Workspace;
  static constexpr int n_constraints = Body::n_constraints;

  /// `driving` contains the loads that depend on time.
  DissipativeBody(Body body, const Dissipation& dissipation, const loads::Loads& driving = {})
      : body_(std::move(body)), dissipation_(dissipation), driving_(driving), driven_(loads::depend_on_time(driving)) {}

  bool time_dependent() const { return driven_ || mechanics::time_dependent(body_); }
  bool velocity_dependent() const { return dissipation_.present(); }
  bool dissipative() const { return dissipation_.present(); }

  /// Sets the first three columns of f to all forces on Q without the reaction, and the last column to (s̈, s̈', 0)ᵀ.
  /// Fails if the force of the body fails.
  mechanics::Status force(double t, const Vector& q, const Vector& v, Workspace& w, Vector& f) const {
    const Eigen::Matrix3d Q = matrix(q), Qdot = matrix(v);
    Eigen::Matrix3d F = Eigen::Matrix3d::Zero();
    if (mechanics::Status status = body_.force(t, Q, Qdot, w, F); !status) return status;
    const double power = dissipation_.add_force(body_.reference(), Q, Qdot, F);
    const double given = driven_ ? add_driving(t, Q, F) : 0;
    f << F, Eigen::Vector3d(power, given, 0);
    return {};
  }
  /// Solves the stages of a Gauss step in lanes, and sets stages.converged (mechanics/core/stage_by_stage.h). Returns
  /// false and does nothing if the lanes cannot compute the self-gravity accurately.
  bool solve_stages_in_lanes(mechanics::GaussStages& stages) const requires(Body::knows_stages) {
    if (!takes_gravity_in_lanes(body_.of_stages(), Eigen::Map<const Eigen::Matrix3d>(stages.q))) return false;
    const AccountsOfStages accounts = accounts_of_stages(dissipation_, driving_, stages);
    solve_stages_of_body(body_.of_stages(), BodyEntries::with_accounts, &accounts, stages);
    return true;
  }
  double cost_of_iteration() const requires(Body::knows_stages) {
    return reduced::cost_of_iteration(body_.of_stages(), BodyEntries::with_accounts);
  }
  void apply_inverse_mass(const Vector& f, Vector& a) const {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    body_.apply_inverse_mass(matrix(f), A);
    const Eigen::Vector3d last = f.col(3);
    a << A, last;
  }
  void apply_mass(const Vector& v, Vector& f) const {
    Eigen::Matrix3d F = Eigen::Matrix3d::Zero();
    body_.apply_mass(matrix(v), F);
    const Eigen::Vector3d last = v.col(3);
    f << F, last;
  }
  /// Adds the dissipative force −∂R/∂Q̇ at the velocity u to f. This force is linear in u (mechanics/core/damping.h).
  void add_damping(const mechanics::VectorState<Vector>& state, const Vector& u, mechanics::Linearization,
                   Vector& f) const {
    Eigen::Matrix3d F = matrix(f);
    dissipation_.add_force(body_.reference(), matrix(state.q), matrix(u), F);
    f.leftCols<3>() = F;
  }
  mechanics::Status constraint(const Vector& q, Multiplier& g) const { return body_.constraint(matrix(q), g); }
  void constraint_rate(const Vector& q, const Vector& v, Multiplier& r) const {
    body_.constraint_rate(matrix(q), matrix(v), r);
  }
  void constraint_curvature(const Vector& q, const Vector& v, Multiplier& r) const {
    body_.constraint_curvature(matrix(q), matrix(v), r);
  }
  void add_reaction(const Vector& q, const Multiplier& lambda, Vector& f) const {
    Eigen::Matrix3d F = matrix(f);
    body_.add_reaction(matrix(q), lambda, F);
    f.leftCols<3>() = F;
  }
  mechanics::SolveReport solve_gram(const Vector& q1, const Vector& q0, const Multiplier& r, Workspace& w,
                                    Multiplier& lambda) const {
    return body_.solve_gram(matrix(q1), matrix(q0), r, w, lambda);
  }
  double constraint_tolerance() const { return body_.constraint_tolerance(); }

  Vector make_vector() const { return Vector::Zero(); }
  Multiplier make_multiplier() const { return {}; }
  Workspace make_workspace() const { return body_.make_workspace(); }

  const Body& body() const { return body_; }
  static Eigen::Matrix3d matrix(const Vector& q) { return q.leftCols<3>(); }
  mechanics::VectorState<Eigen::Matrix3d> motion(const mechanics::VectorState<Vector>& state) const {
    return {state.t, matrix(state.q), matrix(state.v)};
  }
  void add_taken(double energy, Vector& v) const { v(0, 3) += energy; }
  double dissipated(const mechanics::VectorState<Vector>& state) const { return state.v(0, 3); }
  /// V_t − W: the energy of the loads that depend on time, minus the energy that these loads have given. The result is
  /// 0 if there are no such loads.
  double driven_energy(const mechanics::VectorState<Vector>& state) const {
    if (!driven_) return 0;
    return ExternalPotential(loads::driving(driving_, state.t)).energy(body_.reference(), matrix(state.q)) -
           state.v(1, 3);
  }
  /// The state of this form that has the same time, Q and Q̇ as `motion`, and D = W = 0.
  static mechanics::VectorState<Vector> state_of(const mechanics::VectorState<Eigen::Matrix3d>& motion) {
    mechanics::VectorState<Vector> state{motion.t, Vector::Zero(), Vector::Zero()};
    state.q.leftCols<3>() = motion.q;
    state.v.leftCols<3>() = motion.v;
    return state;
  }

 private:
  /// Adds the force −∂V_t/∂Q of the loads that depend on time to f. Returns the power ∂V_t/∂t that these loads give.
  double add_driving(double t, const Eigen::Matrix3d& Q, Eigen::Matrix3d& f) const {
    Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
    ExternalPotential(loads::driving(driving_, t)).add_gradient(body_.reference(), Q, gradient);
    f -= gradient;
    return ExternalPotential(loads::driving_rate(driving_, t)).energy(body_.reference(), Q);
  }

  Body body_;
  Dissipation dissipation_;
  loads::Loads driving_;
  bool driven_;  ///< true if a load depends on time
};

}  // namespace pseudorigid::reduced
