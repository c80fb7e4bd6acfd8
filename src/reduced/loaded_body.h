#pragma once
/// The pseudo-rigid body with every load and every further coordinate. The body has the mass M, the volume Vol, the
/// inertia E₀ and the multiplier Λ. Viscoelastic branches have the internal metrics C_b and the relaxation times τ_b,
/// and companions have the coordinates s_k (mechanics/core/orbit.h). The equations of motion are
///
///   Q̈ E₀ = f_Q − ∂V_c/∂Q − ∂R/∂Q̇ − ∂V_t/∂Q − T_s Q E₀ − Vol Σ P_b(Q, C_b) + Λ Q⁻ᵀ,
///   M c̈  = M (b − T c) − ∂V_c/∂c − ∂R/∂ċ − ∂V_t/∂c,      if there are planes,
///   s̈_k  = −∂U/∂s_k(S, s),   S = Q E₀ Qᵀ,
///   Ċ_b  = (1/τ_b)(Ĉ − ⅓ tr(Ĉ C_b⁻¹) C_b),   Ĉ = (det Q)^{−2/3} QᵀQ.
///
/// The force f_Q is that of the conservative body. The other terms are
///
///   V_c(Q, c, t)   the energy of contact with rigid planes, which couples the centre of mass c to Q (plane_forces.h)
///   R              Rayleigh's function of viscosity, drag (dissipation.h), damping of planes and friction
///   b, T           the acceleration and the quadratic potential on c (without planes, center_of_mass.h computes c)
///   V_t(Q, c, t)   the energy of the loads that depend on time
///   U, T_s         the interaction with companions and its quadratic potential (mechanics/core/orbit.h)
///   P_b            the stress of a branch (materials/maxwell_branch.h)
///
/// As in dissipative_body.h, some velocities are energies. D is the dissipated energy, and D_b is the energy that
/// branch b has dissipated, which is a part of D. W is the energy that loads and moving planes have given. The columns
/// of the vectors are
///
///   q = [Q | c | e_1 e_2 | s_1 s_2 | C_1 … C_4],   v = [Q̇ | ċ | (D, W, D_1) (D_2, D_3, D_4) | ṡ_1 ṡ_2 | 0].
///
/// The columns e_1 and e_2 contain the integrals of the energies over time, which are not used. A metric C_b has two
/// columns, with the entries 00, 01, 02 and 11, 12, 22. Columns that a body does not need are 0. Metrics have no mass
/// and no velocity (mechanics/core/relaxation.h).

#include <utility>

#include "loads/list.h"
#include "loads/viscoelasticity.h"
#include "materials/eigen_tensor.h"
#include "mechanics/core/constrained_system.h"
#include "mechanics/core/linearization.h"
#include "mechanics/core/orbiting_system.h"
#include "mechanics/core/relaxation.h"
#include "mechanics/core/second_order_field.h"
#include "reduced/dissipation.h"
#include "reduced/external_potential.h"
#include "reduced/plane_forces.h"

namespace pseudorigid::reduced {

template <class Body>
class LoadedBody {
  using Metric = materials::Symmetric<double>;
  static constexpr int n_companions = mechanics::Orbit::most_companions,
                       n_branches = static_cast<int>(loads::Viscoelasticity::most_branches);
  /// Index of the first column of each part of a vector.
  static constexpr int at_center = 3, at_energies = 4, at_companions = 6, at_metrics = at_companions + n_companions,
                       n_columns = at_metrics + 2 * n_branches;

 public:
  using Vector = Eigen::Matrix<double, 3, n_columns>;
  using Multiplier = typename Body::Multiplier;
  struct Workspace {
    typename Body::Workspace body{};
    /// If this pointer is not null and there are planes, springs on the whole surface replace the pressure, the damping
    /// and the friction of contact. The springs pull each point of the surface towards its position for the coordinates
    /// `*held_at`, with the stiffness Planes::stiffness_of_all. The total stiffness is then an upper bound for the
    /// stiffness with contact. The search for a stable step needs this bound.
    const Vector* held_at = nullptr;
  };
  static constexpr int n_constraints = Body::n_constraints;

  LoadedBody(Body body, const loads::Loads& loads)
      : body_(std::move(body)),
        constant_(loads::constant_forcing(loads)),
        dissipation_(Dissipation::of(constant_)),
        planes_(constant_.planes, body_.reference().shape),
        orbit_(constant_.companions, constant_.gravity_constant, body_.reference().mass),
        loads_(loads),
        driven_(loads::depend_on_time(loads)) {}

  bool time_dependent() const { return driven_; }
  bool velocity_dependent() const { return constant_.damped(); }
  bool dissipative() const { return constant_.dissipative(); }
  bool damping_is_linear() const { return !constant_.planes.rough(); }
  bool has_contact() const { return !constant_.planes.empty(); }
  bool relaxes() const { return !branches().empty(); }

  /// Sets f to all forces on all coordinates, without the reaction, and to the powers of D and W. Fails if the force of
  /// the body fails.
  mechanics::Status force(double t, const Vector& q, const Vector& v, Workspace& w, Vector& f) const {
    const Eigen::Matrix3d Q = matrix(q);
    loads::AffineForce F;
    if (mechanics::Status status = body_.force(t, Q, matrix(v), w.body, F.on_Q); !status) return status;
    loads::ContactPower power = has_contact() ? add_contact(t, q, w, F) : loads::ContactPower{};
    if (constant_.damped()) power += add_dissipation(t, q, v, w, F);
    if (driven_) power.given += add_driving(t, Q, center(q), F);
    if (relaxes()) F.on_Q -= body_.reference().volume * stress_of_branches(q);
    f.setZero();
    if (orbit_.n() > 0) {
      const Eigen::Matrix3d QE0 = Q * body_.reference().E0;
      const mechanics::Orbit::Columns s = companions(q);
      F.on_Q -= orbit_.tide(s) * QE0;
      f.middleCols(at_companions, orbit_.n()) = orbit_.force(QE0 * Q.transpose(), s);
    }
    f.template leftCols<3>() = F.on_Q;
    if (has_contact()) f.col(at_center) = F.on_center;
    f(0, at_energies) = power.taken;
    f(1, at_energies) = power.given;
    return {};
  }
  /// Replaces the metrics in q by their values at the end of a step of length h. `before` and q are the positions at
  /// the start and at the end of the step, and the metrics follow the mean of their strains. Adds the energy that the
  /// branches dissipate to D and to the D_b in v.
  void relax(double h, const Vector& before, Vector& q, Vector& v) const {
    const Metric strain = materials::mean_strain(materials::to_tensor(matrix(before)), materials::to_tensor(matrix(q)));
    for (std::size_t b = 0; b < branches().size(); ++b) {
      Metric metric = metric_of(q, b);
      const double lost = body_.reference().volume * branches()[b].modulus *
                          materials::relax(strain, h / branches()[b].relaxation_time, metric);
      set_metric(metric, b, q);
      add_taken(lost, v);
      v.col(at_energies).data()[2 + b] += lost;
    }
  }
  void apply_inverse_mass(const Vector& f, Vector& a) const {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    body_.apply_inverse_mass(matrix(f), A);
    a = f;
    a.template leftCols<3>() = A;
    a.col(at_center) /= body_.reference().mass;
  }
  void apply_mass(const Vector& v, Vector& f) const {
    Eigen::Matrix3d F = Eigen::Matrix3d::Zero();
    body_.apply_mass(matrix(v), F);
    f = v;
    f.template leftCols<3>() = F;
    f.col(at_center) *= body_.reference().mass;
  }
  /// Adds −C u to f. The matrix C is the linearisation `kind` of viscosity, drag, damping and friction at `state`
  /// (mechanics/core/damping.h).
  void add_damping(const mechanics::VectorState<Vector>& state, const Vector& u, mechanics::Linearization kind,
                   Vector& f) const {
    const Eigen::Matrix3d Q = matrix(state.q), U = matrix(u);
    const Eigen::Vector3d c = center(state.q), of_center = center(u);
    loads::AffineForce F;
    dissipation_.add_force(body_.reference(), Q, U, F.on_Q);
    add_drag(of_center, F);
    planes_.add_damping_change(state.t, Q, c, matrix(state.v), center(state.v), U, of_center, kind, F);
    f.template leftCols<3>() += F.on_Q;
    f.col(at_center) += F.on_center;
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
  const mechanics::Orbit& orbit() const { return orbit_; }
  static Eigen::Matrix3d matrix(const Vector& q) { return q.template leftCols<3>(); }
  static Eigen::Vector3d center(const Vector& q) { return q.col(at_center); }
  /// The coordinates s_k of the companions in a position q, or their rates in a velocity.
  mechanics::Orbit::Columns companions(const Vector& q) const { return q.middleCols(at_companions, orbit_.n()); }
  void set_companions(const mechanics::Orbit::Columns& s, Vector& q) const {
    q.middleCols(at_companions, orbit_.n()) = s;
  }
  mechanics::VectorState<Eigen::Matrix3d> motion(const mechanics::VectorState<Vector>& state) const {
    return {state.t, matrix(state.q), matrix(state.v)};
  }

  void add_taken(double energy, Vector& v) const { v(0, at_energies) += energy; }
  double dissipated(const mechanics::VectorState<Vector>& state) const { return state.v(0, at_energies); }
  /// The energies D_b that the branches have dissipated.
  Eigen::Vector4d dissipated_by_branches(const mechanics::VectorState<Vector>& state) const {
    return Eigen::Vector4d::Map(state.v.col(at_energies).data() + 2);
  }
  /// V_t − W: the energy of the loads that depend on time, minus the energy that these loads and moving planes have
  /// given. The result is 0 if no load depends on time and no plane moves.
  double driven_energy(const mechanics::VectorState<Vector>& state) const {
    if (!driven_) return 0;
    return energy_of(loads::driving(loads_, state.t), matrix(state.q), center(state.q)) - state.v(1, at_energies);
  }
  /// Summary of the contacts with all planes at the time t and the position q.
  loads::Contact contact(double t, const Vector& q) const { return planes_.contact(t, matrix(q), center(q)); }
  /// The energy that the branches store in the whole body.
  double energy_of_branches(const Vector& q) const {
    return body_.reference().volume * materials::energy_of_branches(materials::to_tensor(matrix(q)), inverse_sum(q),
                                                                    materials::sum_of_moduli(branches()));
  }
  /// The stress Σ P_b of all branches, a first Piola–Kirchhoff stress.
  Eigen::Matrix3d stress_of_branches(const Vector& q) const {
    return materials::to_matrix(materials::stress_of_branches(materials::to_tensor(matrix(q)), inverse_sum(q)));
  }

  /// The state with the same time, Q and Q̇ as `motion`, with this position and velocity of the centre of mass, and
  /// with 0 elsewhere.
  static mechanics::VectorState<Vector> state_of(const mechanics::VectorState<Eigen::Matrix3d>& motion,
                                                 const Eigen::Vector3d& position, const Eigen::Vector3d& velocity) {
    mechanics::VectorState<Vector> state{motion.t, Vector::Zero(), Vector::Zero()};
    state.q.template leftCols<4>() << motion.q, position;
    state.v.template leftCols<4>() << motion.v, velocity;
    return state;
  }
  /// The state at the start, with this motion of the body and the companions at their start. The internal metrics are
  /// those of relaxed branches if Branches::relaxed is true, and otherwise those of the undeformed body. Without
  /// planes, c is not a coordinate, and `position` and `velocity` are not used.
  mechanics::VectorState<Vector> start(const mechanics::VectorState<Eigen::Matrix3d>& motion,
                                       const Eigen::Vector3d& position, const Eigen::Vector3d& velocity) const {
    const Eigen::Vector3d none = Eigen::Vector3d::Zero();
    mechanics::VectorState<Vector> state =
        has_contact() ? state_of(motion, position, velocity) : state_of(motion, none, none);
    const Metric metric = constant_.branches.relaxed ? materials::isochoric_strain(materials::to_tensor(motion.q))
                                                     : materials::identity_metric;
    for (std::size_t b = 0; b < branches().size(); ++b) set_metric(metric, b, state.q);
    return with_companions(state, {orbit_.position(), orbit_.velocity()});
  }
  /// Returns `state` with the coordinates of the companions and their rates from `motion`.
  mechanics::VectorState<Vector> with_companions(mechanics::VectorState<Vector> state,
                                                 const mechanics::Orbit::Motion& motion) const {
    set_companions(motion.s, state.q);
    set_companions(motion.sdot, state.v);
    return state;
  }

 private:
  const materials::MaxwellBranches& branches() const { return constant_.branches.list; }
  static Metric metric_of(const Vector& q, std::size_t b) {
    const double* m = q.col(at_metrics + 2 * static_cast<int>(b)).data();
    return {{m[0], m[1], m[2], m[3], m[4], m[5]}};
  }
  static void set_metric(const Metric& metric, std::size_t b, Vector& q) {
    std::copy_n(metric.a, Metric::n_entries, q.col(at_metrics + 2 * static_cast<int>(b)).data());
  }
  /// Σ μ_b C_b⁻¹ over the branches b, with their moduli μ_b.
  Metric inverse_sum(const Vector& q) const {
    Metric A{};
    for (std::size_t b = 0; b < branches().size(); ++b)
      materials::add_branch(branches()[b].modulus, metric_of(q, b), A);
    return A;
  }
  /// Sets the force on c to the force of the loads that do not depend on time. Then adds the pressure of contact, or
  /// the springs that replace the contact. Returns the power that moving planes give, or 0 with springs.
  loads::ContactPower add_contact(double t, const Vector& q, const Workspace& w, loads::AffineForce& F) const {
    const Eigen::Vector3d c = center(q);
    F.on_center = body_.reference().mass * (constant_.acceleration - constant_.quadratic * c);
    if (!w.held_at) return {.given = planes_.add_pressure(t, matrix(q), c, F)};
    planes_.add_springs(matrix(q) - matrix(*w.held_at), c - center(*w.held_at), F);
    return {};
  }
  /// Adds viscosity and drag. Without springs, also adds the damping of planes and friction. Returns the power that
  /// these forces dissipate, and the power that moving planes give through the damping.
  loads::ContactPower add_dissipation(double t, const Vector& q, const Vector& v, const Workspace& w,
                                      loads::AffineForce& F) const {
    const Eigen::Matrix3d Q = matrix(q), Qdot = matrix(v);
    const Eigen::Vector3d c = center(q), cdot = center(v);
    loads::ContactPower power{.taken = dissipation_.add_force(body_.reference(), Q, Qdot, F.on_Q)};
    power.taken += add_drag(cdot, F);
    if (w.held_at) return power;
    power += planes_.add_damping(t, Q, c, Qdot, cdot, F);
    power.taken += planes_.add_friction(t, Q, c, Qdot, cdot, F);
    return power;
  }
  /// Adds the drag on the centre of mass. Returns the power that it dissipates.
  double add_drag(const Eigen::Vector3d& cdot, loads::AffineForce& F) const {
    const Eigen::Vector3d drag = constant_.drag * body_.reference().mass * cdot;
    F.on_center -= drag;
    return drag.dot(cdot);
  }
  /// Adds the forces −∂V_t/∂Q and −∂V_t/∂c of the loads that depend on time to F. Returns the power ∂V_t/∂t that these
  /// loads give.
  double add_driving(double t, const Eigen::Matrix3d& Q, const Eigen::Vector3d& c, loads::AffineForce& F) const {
    const loads::Forcing now = loads::driving(loads_, t);
    Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
    ExternalPotential(now).add_gradient(body_.reference(), Q, gradient);
    F.on_Q -= gradient;
    F.on_center += body_.reference().mass * (now.acceleration - now.quadratic * c);
    return energy_of(loads::driving_rate(loads_, t), Q, c);
  }
  /// The energy of a forcing for the deformation Q and the centre of mass c.
  double energy_of(const loads::Forcing& forcing, const Eigen::Matrix3d& Q, const Eigen::Vector3d& c) const {
    return ExternalPotential(forcing).energy(body_.reference(), Q) +
           body_.reference().mass * (0.5 * c.dot(forcing.quadratic * c) - forcing.acceleration.dot(c));
  }

  Body body_;
  loads::Forcing constant_;  ///< loads that do not depend on time, with all planes
  Dissipation dissipation_;
  PlaneForces planes_;
  mechanics::Orbit orbit_;
  loads::Loads loads_;
  bool driven_;  ///< true if a load depends on time or a plane moves
};

}  // namespace pseudorigid::reduced
