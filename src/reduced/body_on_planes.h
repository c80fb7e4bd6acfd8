#pragma once
/// The pseudo-rigid body x = c + Q X in contact with rigid planes, which may move along their normals. The contact
/// energy V_c(Q, c, t) (loads/ellipsoid_contact.h) couples the centre of mass c to Q,
///
///   Q̈ E₀ = f_Q − ∂V_c/∂Q − ∂R/∂Q̇ + Λ Q⁻ᵀ,   M c̈ = M (b − T c) − ∂V_c/∂c − ∂R/∂ċ,
///
/// with the mass M, the loads b and T (center_of_mass.h) and the multiplier Λ. Rayleigh's function R contains the
/// viscosity, the drag, the damping of the planes and the friction on the planes. The term f_Q is the force on Q
/// without planes and dissipation. Loads that depend on time add −∂V_t/∂Q and −∂V_t/∂c with their energy V_t(Q, c, t).
/// As in dissipative_body.h, the velocities of two further coordinates s and s' are energies: the dissipated energy D,
/// and the energy W that loads and moving planes have given. The vectors are q = [Q | c | (s, s', 0)ᵀ] and v = [Q̇ | ċ |
/// (D, W, 0)ᵀ].

#include "loads/ellipsoid_friction.h"
#include "loads/list.h"
#include "mechanics/core/constrained_system.h"
#include "mechanics/core/linearization.h"
#include "mechanics/core/second_order_field.h"
#include "reduced/dissipation.h"
#include "reduced/external_potential.h"

namespace pseudorigid::reduced {

template <class Body>
class BodyOnPlanes {
 public:
  using Vector = Eigen::Matrix<double, 3, 5>;
  using Multiplier = typename Body::Multiplier;
  struct Workspace {
    typename Body::Workspace body{};
    /// If this pointer is not null, springs on the whole surface replace the contact. They pull each point of the
    /// surface towards its position in the configuration `*held_at`, with the stiffness Planes::stiffness_of_all. The
    /// total stiffness is then an upper bound for the stiffness with contact.
    const Vector* held_at = nullptr;
  };
  static constexpr int n_constraints = Body::n_constraints;

  BodyOnPlanes(Body body, const loads::Loads& loads)
      : body_(std::move(body)),
        constant_(loads::constant_forcing(loads)),
        dissipation_(Dissipation::of(constant_)),
        loads_(loads),
        driven_(loads::depend_on_time(loads)) {}

  bool time_dependent() const { return driven_; }
  bool velocity_dependent() const { return constant_.dissipative(); }
  bool dissipative() const { return constant_.dissipative(); }
  bool has_contact() const { return !constant_.planes.empty(); }
  bool damping_is_linear() const { return !constant_.planes.rough(); }

  mechanics::Status force(double t, const Vector& q, const Vector& v, Workspace& w, Vector& f) const {
    const Eigen::Matrix3d Q = matrix(q), Qdot = matrix(v);
    loads::AffineForce F;
    if (mechanics::Status status = body_.force(t, Q, Qdot, w.body, F.on_Q); !status) return status;
    const Eigen::Vector3d c = center(q), cdot = center(v);
    const double mass = body_.reference().mass;
    F.on_center = mass * (constant_.acceleration - constant_.quadratic * c);
    loads::ContactPower power;
    if (w.held_at)
      hold(Q - matrix(*w.held_at), c - center(*w.held_at), F);
    else
      power.given += add_contact(t, Q, c, F);
    power += add_dissipation(
        Q, c, Qdot, cdot, [t](const loads::Plane& plane) { return plane.at(t); }, F);
    if (!w.held_at) power.taken += add_friction(t, Q, c, Qdot, cdot, F);
    if (driven_) power.given += add_driving(t, Q, c, F);
    f << F.on_Q, F.on_center, Eigen::Vector3d(power.taken, power.given, 0);
    return {};
  }
  void apply_inverse_mass(const Vector& f, Vector& a) const {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    body_.apply_inverse_mass(matrix(f), A);
    const Eigen::Vector3d of_center = center(f) / body_.reference().mass, last = f.col(4);
    a << A, of_center, last;
  }
  void apply_mass(const Vector& v, Vector& f) const {
    Eigen::Matrix3d F = Eigen::Matrix3d::Zero();
    body_.apply_mass(matrix(v), F);
    const Eigen::Vector3d of_center = center(v) * body_.reference().mass, last = v.col(4);
    f << F, of_center, last;
  }
  /// f ← f − C u for the damping at a state (mechanics/core/damping.h). The speed of planes does not change with u.
  void add_damping(const mechanics::VectorState<Vector>& state, const Vector& u, mechanics::Linearization kind,
                   Vector& f) const {
    const Eigen::Matrix3d Q = matrix(state.q), Qdot = matrix(state.v), dQdot = matrix(u);
    const Eigen::Vector3d c = center(state.q), cdot = center(state.v), dcdot = center(u);
    loads::AffineForce F;
    const auto stopped = [&](const loads::Plane& plane) { return plane.stopped_at(state.t); };
    add_dissipation(Q, c, dQdot, dcdot, stopped, F);
    if (!damping_is_linear())
      for (const loads::Plane& plane : constant_.planes) {
        const loads::EllipsoidContact contact = contact_with(plane.at(state.t), Q, c);
        loads::EllipsoidFriction(contact, Qdot, cdot).add_change(dQdot, dcdot, kind, F);
      }
    f.template leftCols<3>() += F.on_Q;
    f.col(3) += F.on_center;
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
    f.template leftCols<3>() = F;
  }
  mechanics::SolveReport solve_gram(const Vector& q1, const Vector& q0, const Multiplier& r, Workspace& w,
                                    Multiplier& lambda) const {
    return body_.solve_gram(matrix(q1), matrix(q0), r, w.body, lambda);
  }
  double constraint_tolerance() const { return body_.constraint_tolerance(); }

  Vector make_vector() const { return Vector::Zero(); }
  Multiplier make_multiplier() const { return {}; }
  Workspace make_workspace() const { return {body_.make_workspace()}; }

  const Body& body() const { return body_; }
  static Eigen::Matrix3d matrix(const Vector& q) { return q.template leftCols<3>(); }
  static Eigen::Vector3d center(const Vector& q) { return q.col(3); }
  mechanics::VectorState<Eigen::Matrix3d> motion(const mechanics::VectorState<Vector>& state) const {
    return {state.t, matrix(state.q), matrix(state.v)};
  }
  void add_taken(double energy, Vector& v) const { v(0, 4) += energy; }
  double dissipated(const mechanics::VectorState<Vector>& state) const { return state.v(0, 4); }
  /// V_t − W, with the energy V_t(Q, c, t) of the loads that depend on time. The result is 0 if there are no such loads
  /// and no planes in motion.
  double driven_energy(const mechanics::VectorState<Vector>& state) const {
    if (!driven_) return 0;
    return energy_of(loads::driving(loads_, state.t), matrix(state.q), center(state.q)) - state.v(1, 4);
  }
  /// Summary of the contacts with all planes at the time t and the position q.
  loads::Contact contact(double t, const Vector& q) const {
    const loads::Planes planes = constant_.planes.at(t);
    std::vector<loads::PlaneContact> contacts;
    for (const loads::Plane& plane : planes) contacts.push_back(contact_with(plane, matrix(q), center(q)).contact());
    return loads::summary(planes, contacts);
  }

  static mechanics::VectorState<Vector> state_of(const mechanics::VectorState<Eigen::Matrix3d>& motion,
                                                 const Eigen::Vector3d& position, const Eigen::Vector3d& velocity) {
    mechanics::VectorState<Vector> state{motion.t, Vector::Zero(), Vector::Zero()};
    state.q << motion.q, position, Eigen::Vector3d::Zero();
    state.v << motion.v, velocity, Eigen::Vector3d::Zero();
    return state;
  }

 private:
  loads::EllipsoidContact contact_with(const loads::Plane& plane, const Eigen::Matrix3d& Q,
                                       const Eigen::Vector3d& c) const {
    return {plane, body_.reference().shape, Q, c};
  }
  /// Adds −k∮u to the force on c and −k∮u Xᵀ to the force on Q, with k = stiffness_of_all(). The arguments Q and c are
  /// differences from the configuration *held_at, so that u = c + Q X is the displacement. The integrals are over the
  /// unit sphere of ξ, with X = S ξ.
  void hold(const Eigen::Matrix3d& Q, const Eigen::Vector3d& c, loads::AffineForce& F) const {
    const double k = constant_.planes.stiffness_of_all(), area = 4 * std::numbers::pi;
    const Eigen::Matrix3d& S = body_.reference().shape;
    F.on_center -= k * area * c;
    F.on_Q -= k * area / 3 * Q * S * S.transpose();
  }
  /// F ← F − ∂V_c/∂(Q, c). Returns the power that planes give.
  double add_contact(double t, const Eigen::Matrix3d& Q, const Eigen::Vector3d& c, loads::AffineForce& F) const {
    double given = 0;
    for (const loads::Plane& plane : constant_.planes) {
      const loads::EllipsoidContact contact = contact_with(plane.at(t), Q, c);
      contact.add_force(F);
      given += contact.given();
    }
    return given;
  }
  /// Adds the forces that are linear in the velocity: viscosity, drag and the damping of planes. plane_now(plane) is a
  /// plane at the present time.
  template <class PlaneNow>
  loads::ContactPower add_dissipation(const Eigen::Matrix3d& Q, const Eigen::Vector3d& c, const Eigen::Matrix3d& Qdot,
                                      const Eigen::Vector3d& cdot, const PlaneNow& plane_now,
                                      loads::AffineForce& F) const {
    if (!constant_.dissipative()) return {};
    loads::ContactPower power{.taken = dissipation_.add_force(body_.reference(), Q, Qdot, F.on_Q)};
    const Eigen::Vector3d drag = constant_.drag * body_.reference().mass * cdot;
    F.on_center -= drag;
    power.taken += drag.dot(cdot);
    for (const loads::Plane& plane : constant_.planes)
      power += contact_with(plane_now(plane), Q, c).add_damping(Qdot, cdot, F);
    return power;
  }
  /// Adds the friction of all planes to F. Returns the power that it dissipates.
  double add_friction(double t, const Eigen::Matrix3d& Q, const Eigen::Vector3d& c, const Eigen::Matrix3d& Qdot,
                      const Eigen::Vector3d& cdot, loads::AffineForce& F) const {
    double power = 0;
    if (damping_is_linear()) return power;
    for (const loads::Plane& plane : constant_.planes) {
      const loads::EllipsoidContact contact = contact_with(plane.at(t), Q, c);
      power += loads::EllipsoidFriction(contact, Qdot, cdot).add_force(F);
    }
    return power;
  }
  /// F ← F − ∂V_t/∂(Q, c). Returns ∂V_t/∂t.
  double add_driving(double t, const Eigen::Matrix3d& Q, const Eigen::Vector3d& c, loads::AffineForce& F) const {
    const loads::Forcing now = loads::driving(loads_, t);
    Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
    ExternalPotential(now).add_gradient(body_.reference(), Q, gradient);
    F.on_Q -= gradient;
    F.on_center += body_.reference().mass * (now.acceleration - now.quadratic * c);
    return energy_of(loads::driving_rate(loads_, t), Q, c);
  }
  double energy_of(const loads::Forcing& forcing, const Eigen::Matrix3d& Q, const Eigen::Vector3d& c) const {
    return ExternalPotential(forcing).energy(body_.reference(), Q) +
           body_.reference().mass * (0.5 * c.dot(forcing.quadratic * c) - forcing.acceleration.dot(c));
  }

  Body body_;
  loads::Forcing constant_;  ///< loads that do not depend on time
  Dissipation dissipation_;
  loads::Loads loads_;
  bool driven_;
};

}  // namespace pseudorigid::reduced
