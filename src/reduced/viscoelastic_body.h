#pragma once
/// A form of the pseudo-rigid body with Maxwell branches (materials/maxwell_branch.h). With the forces f + Gᵀλ of the
/// form, the volume Vol and the internal metrics C_b,
///
///   M Q̈ = f − Vol Σ P_b(Q, C_b) + Gᵀλ,   Ċ_b = (1/τ_b)(Ĉ − ⅓ tr(Ĉ C_b⁻¹) C_b),   Ĉ = (det Q)^{−2/3} QᵀQ.
///
/// The vectors are those of the form, with two further columns for each branch: (C₀₀, C₀₁, C₀₂) and (C₁₁, C₁₂, C₂₂).
/// These columns have no mass and no velocity (mechanics/core/relaxation.h).

#include <utility>

#include "loads/viscoelasticity.h"
#include "materials/eigen_tensor.h"
#include "mechanics/core/constrained_system.h"
#include "mechanics/core/linearization.h"
#include "mechanics/core/relaxation.h"
#include "mechanics/core/second_order_field.h"

namespace pseudorigid::reduced {

/// `Inner` is a DissipativeBody, a BodyOnPlanes or an OrbitingBody. Members that only some of them have exist if
/// `Inner` has them.
template <class Inner>
class ViscoelasticBody {
  static constexpr int n_inner = Inner::Vector::ColsAtCompileTime,
                       n_metrics = 2 * static_cast<int>(loads::Viscoelasticity::most_branches);
  using Metric = materials::Symmetric<double>;

 public:
  using Vector = Eigen::Matrix<double, 3, n_inner + n_metrics>;
  using Multiplier = typename Inner::Multiplier;
  struct Workspace {
    typename Inner::Workspace inner;
    const Vector* held_at = nullptr;  ///< see BodyOnPlanes::Workspace
    typename Inner::Vector inner_held_at = Inner::Vector::Zero();
  };
  static constexpr int n_constraints = Inner::n_constraints;
  static constexpr bool always_relaxes = true;

  ViscoelasticBody(Inner inner, loads::Branches branches) : inner_(std::move(inner)), branches_(std::move(branches)) {}

  bool time_dependent() const { return inner_.time_dependent(); }
  bool velocity_dependent() const { return inner_.velocity_dependent(); }
  bool dissipative() const { return true; }
  bool relaxes() const { return true; }
  bool damping_is_linear() const requires requires(const Inner& inner) { inner.damping_is_linear(); }
  { return inner_.damping_is_linear(); }

  mechanics::Status force(double t, const Vector& q, const Vector& v, Workspace& w, Vector& f) const {
    if constexpr (requires { w.inner.held_at; }) {
      if (w.held_at) w.inner_held_at = inner(*w.held_at);
      w.inner.held_at = w.held_at ? &w.inner_held_at : nullptr;
    }
    typename Inner::Vector of_inner;
    if (auto status = inner_.force(t, inner(q), inner(v), w.inner, of_inner); !status) return status;
    f.setZero();
    f.template leftCols<n_inner>() = of_inner;
    f.template leftCols<3>() -= body().reference().volume * stress_of_branches(q);
    return {};
  }
  double relax(double h, const Vector& before, Vector& q) const {
    const Metric strain = materials::mean_strain(materials::to_tensor(matrix(before)), materials::to_tensor(matrix(q)));
    double lost = 0;
    for (int b = 0; b < n_branches(); ++b) {
      const auto& branch = branches_.list[static_cast<std::size_t>(b)];
      Metric metric = metric_of(q, b);
      lost += branch.modulus * materials::relax(strain, h / branch.relaxation_time, metric);
      set_metric(metric, b, q);
    }
    return body().reference().volume * lost;
  }

  bool drifts() const { return mechanics::drifts(inner_); }
  void drift(double h, const Vector& before, Vector& q, Vector& v) const {
    if constexpr (mechanics::Drifting<Inner>) {
      typename Inner::Vector moved = inner(q), velocity = inner(v);
      inner_.drift(h, inner(before), moved, velocity);
      q.template leftCols<n_inner>() = moved;
      v.template leftCols<n_inner>() = velocity;
    }
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
    return inner_.solve_gram(inner(q1), inner(q0), r, w.inner, lambda);
  }
  double constraint_tolerance() const { return inner_.constraint_tolerance(); }

  Vector make_vector() const { return Vector::Zero(); }
  Multiplier make_multiplier() const { return {}; }
  Workspace make_workspace() const { return {inner_.make_workspace()}; }

  const auto& body() const { return inner_.body(); }
  static Eigen::Matrix3d matrix(const Vector& q) { return q.template leftCols<3>(); }
  static Eigen::Vector3d center(const Vector& q) { return q.col(3); }
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
  auto contact(double t, const Vector& q) const requires requires(const Inner& i, const typename Inner::Vector& x) {
    i.contact(0.0, x);
  }
  { return inner_.contact(t, inner(q)); }
  const auto& orbit() const requires requires(const Inner& i) { i.orbit(); }
  { return inner_.orbit(); }
  auto companions(const Vector& q) const requires requires(const Inner& i) { i.orbit(); }
  { return inner_.companions(inner(q)); }
  auto with_companions(mechanics::VectorState<Vector> state, const auto& motion) const requires
      requires(const Inner& i) {
    i.orbit();
  }
  {
    const auto moved = inner_.with_companions(inner_state(state), motion);
    state.q.template leftCols<n_inner>() = moved.q;
    state.v.template leftCols<n_inner>() = moved.v;
    return state;
  }

  const Inner& form() const { return inner_; }
  /// The state of the form, with the branches at their start.
  mechanics::VectorState<Vector> with_branches(const mechanics::VectorState<typename Inner::Vector>& of_inner) const {
    mechanics::VectorState<Vector> state{of_inner.t, Vector::Zero(), Vector::Zero()};
    state.q.template leftCols<n_inner>() = of_inner.q;
    state.v.template leftCols<n_inner>() = of_inner.v;
    const Metric metric = branches_.relaxed ? materials::isochoric_strain(materials::to_tensor(matrix(state.q)))
                                            : materials::identity_metric;
    for (int b = 0; b < n_branches(); ++b) set_metric(metric, b, state.q);
    return state;
  }

  /// The energy that the branches store.
  double energy_of_branches(const Vector& q) const {
    return body().reference().volume * materials::energy_of_branches(materials::to_tensor(matrix(q)), inverse_sum(q),
                                                                     materials::sum_of_moduli(branches_.list));
  }
  /// Σ P_b
  Eigen::Matrix3d stress_of_branches(const Vector& q) const {
    return materials::to_matrix(materials::stress_of_branches(materials::to_tensor(matrix(q)), inverse_sum(q)));
  }

 private:
  int n_branches() const { return static_cast<int>(branches_.list.size()); }
  static Metric metric_of(const Vector& q, int b) {
    const double* m = q.col(n_inner + 2 * b).data();
    return {{m[0], m[1], m[2], m[3], m[4], m[5]}};
  }
  static void set_metric(const Metric& metric, int b, Vector& q) {
    std::copy_n(metric.a, Metric::n_entries, q.col(n_inner + 2 * b).data());
  }
  /// Σ μ_b C_b⁻¹
  Metric inverse_sum(const Vector& q) const {
    Metric A{};
    for (int b = 0; b < n_branches(); ++b)
      materials::add_branch(branches_.list[static_cast<std::size_t>(b)].modulus, metric_of(q, b), A);
    return A;
  }
  static typename Inner::Vector inner(const Vector& q) { return q.template leftCols<n_inner>(); }
  static mechanics::VectorState<typename Inner::Vector> inner_state(const mechanics::VectorState<Vector>& state) {
    return {state.t, inner(state.q), inner(state.v)};
  }
  /// y ← [operation(part of the form) | 0]
  template <class Operation>
  static void map(const Vector& x, Vector& y, const Operation& operation) {
    typename Inner::Vector result;
    operation(inner(x), result);
    y.setZero();
    y.template leftCols<n_inner>() = result;
  }

  Inner inner_;
  loads::Branches branches_;
};

}  // namespace pseudorigid::reduced
