#pragma once
/// The pseudo-rigid body with companions in orbit (mechanics/core/orbit.h). With the coordinates s_k of the companions,
/// the interaction U and its quadratic potential T, the equations of motion are
///
///   M Q̈ = f − T Q E₀ + Gᵀλ,   s̈_k = −∂U/∂s_k(S, s),   S = Q E₀ Qᵀ.
///
/// Here f + Gᵀλ are the forces of the body without companions (dissipative_body.h). The forces of U on Q and s have the
/// same potential, so the energy and the sum of both angular momenta are constant without other loads. The vectors are
/// q = [that of the body | s_1 s_2] and v = [that of the body | ṡ_1 ṡ_2]. Columns of absent companions are 0.

#include <utility>

#include "mechanics/core/constrained_system.h"
#include "mechanics/core/linearization.h"
#include "mechanics/core/orbit.h"
#include "mechanics/core/second_order_field.h"

namespace pseudorigid::reduced {

/// `Inner` is a DissipativeBody.
template <class Inner>
class OrbitingBody {
  static constexpr int n_inner = Inner::Vector::ColsAtCompileTime, n_orbit = mechanics::Orbit::most_companions;

 public:
  using Vector = Eigen::Matrix<double, 3, n_inner + n_orbit>;
  using Multiplier = typename Inner::Multiplier;
  using Workspace = typename Inner::Workspace;
  static constexpr int n_constraints = Inner::n_constraints;

  OrbitingBody(Inner inner, mechanics::Orbit orbit) : inner_(std::move(inner)), orbit_(std::move(orbit)) {}

  bool time_dependent() const { return inner_.time_dependent(); }
  bool velocity_dependent() const { return inner_.velocity_dependent(); }
  bool dissipative() const { return inner_.dissipative(); }

  mechanics::Status force(double t, const Vector& q, const Vector& v, Workspace& w, Vector& f) const {
    typename Inner::Vector of_body;
    if (auto status = inner_.force(t, inner(q), inner(v), w, of_body); !status) return status;
    const Eigen::Matrix3d Q = matrix(q), QE0 = Q * body().reference().E0;
    const mechanics::Orbit::Columns s = companions(q);
    of_body.template leftCols<3>() -= orbit_.tide(s) * QE0;
    f.setZero();
    f.template leftCols<n_inner>() = of_body;
    f.middleCols(n_inner, orbit_.n()) = orbit_.force(QE0 * Q.transpose(), s);
    return {};
  }
  bool drifts() const { return orbit_.n() > 0; }
  void drift(double h, const Vector& before, Vector& q, Vector& v) const {
    mechanics::Orbit::Columns s = companions(before), sdot = companions(v);
    orbit_.drift(h, s, sdot);
    q.middleCols(n_inner, orbit_.n()) = s;
    v.middleCols(n_inner, orbit_.n()) = sdot;
  }
  void apply_inverse_mass(const Vector& f, Vector& a) const {
    map(f, a, [this](const auto& x, auto& y) { inner_.apply_inverse_mass(x, y); });
  }
  void apply_mass(const Vector& v, Vector& f) const {
    map(v, f, [this](const auto& x, auto& y) { inner_.apply_mass(x, y); });
  }
  void add_damping(const mechanics::VectorState<Vector>& state, const Vector& u, mechanics::Linearization kind,
                   Vector& f) const {
    typename Inner::Vector F = inner(f);
    inner_.add_damping(inner_state(state), inner(u), kind, F);
    f.template leftCols<n_inner>() = F;
  }
  mechanics::Status constraint(const Vector& q, Multiplier& g) const { return inner_.constraint(inner(q), g); }
  void constraint_rate(const Vector& q, const Vector& v, Multiplier& r) const {
    inner_.constraint_rate(inner(q), inner(v), r);
  }
  void constraint_curvature(const Vector& q, const Vector& v, Multiplier& r) const {
    inner_.constraint_curvature(inner(q), inner(v), r);
  }
  void add_reaction(const Vector& q, const Multiplier& lambda, Vector& f) const {
    typename Inner::Vector F = inner(f);
    inner_.add_reaction(inner(q), lambda, F);
    f.template leftCols<n_inner>() = F;
  }
  mechanics::SolveReport solve_gram(const Vector& q1, const Vector& q0, const Multiplier& r, Workspace& w,
                                    Multiplier& lambda) const {
    return inner_.solve_gram(inner(q1), inner(q0), r, w, lambda);
  }
  double constraint_tolerance() const { return inner_.constraint_tolerance(); }

  Vector make_vector() const { return Vector::Zero(); }
  Multiplier make_multiplier() const { return {}; }
  Workspace make_workspace() const { return inner_.make_workspace(); }

  const auto& body() const { return inner_.body(); }
  const mechanics::Orbit& orbit() const { return orbit_; }
  static Eigen::Matrix3d matrix(const Vector& q) { return q.template leftCols<3>(); }
  /// The coordinates s_k, or their rates.
  mechanics::Orbit::Columns companions(const Vector& q) const { return q.middleCols(n_inner, orbit_.n()); }
  mechanics::VectorState<Eigen::Matrix3d> motion(const mechanics::VectorState<Vector>& state) const {
    return {state.t, matrix(state.q), matrix(state.v)};
  }
  void add_taken(double energy, Vector& v) const {
    typename Inner::Vector inside = inner(v);
    inner_.add_taken(energy, inside);
    v.template leftCols<n_inner>() = inside;
  }
  double dissipated(const mechanics::VectorState<Vector>& state) const { return inner_.dissipated(inner_state(state)); }
  double driven_energy(const mechanics::VectorState<Vector>& state) const {
    return inner_.driven_energy(inner_state(state));
  }
  /// The state with the same time, Q and Q̇ as `motion`, and with the companions at their start.
  mechanics::VectorState<Vector> start(const mechanics::VectorState<Eigen::Matrix3d>& motion) const {
    const auto of_body = Inner::state_of(motion);
    mechanics::VectorState<Vector> state{motion.t, Vector::Zero(), Vector::Zero()};
    state.q.template leftCols<n_inner>() = of_body.q;
    state.v.template leftCols<n_inner>() = of_body.v;
    return with_companions(state, {orbit_.position(), orbit_.velocity()});
  }
  /// The state with this motion of the companions.
  mechanics::VectorState<Vector> with_companions(mechanics::VectorState<Vector> state,
                                                 const mechanics::Orbit::Motion& motion) const {
    state.q.middleCols(n_inner, orbit_.n()) = motion.s;
    state.v.middleCols(n_inner, orbit_.n()) = motion.sdot;
    return state;
  }

 private:
  static typename Inner::Vector inner(const Vector& q) { return q.template leftCols<n_inner>(); }
  static mechanics::VectorState<typename Inner::Vector> inner_state(const mechanics::VectorState<Vector>& state) {
    return {state.t, inner(state.q), inner(state.v)};
  }
  /// y ← [operation(part of the body) | columns of the companions, which have unit mass]
  template <class Operation>
  static void map(const Vector& x, Vector& y, const Operation& operation) {
    typename Inner::Vector result;
    operation(inner(x), result);
    const Eigen::Matrix<double, 3, n_orbit> rest = x.template rightCols<n_orbit>();
    y << result, rest;
  }

  Inner inner_;
  mechanics::Orbit orbit_;
};

}  // namespace pseudorigid::reduced
