#pragma once
/// The pseudo-rigid body x = QX without rotation and circulation. If the initial Q and Q̇, the inertia E₀ and the loads
/// are diagonal, then Q = diag(a) for all times. V(a) is the potential energy, and Λ is the multiplier. The equation of
/// motion (5.120) of pseudo_rigid_body.h is then
///
///   e_i ä_i = −∂V/∂a_i + Λ/a_i,   ln a₁a₂a₃ = 0,   E₀ = diag(e),
///
///   Λ = [Σ (ȧ_i/a_i)² + Σ ∂V/∂a_i /(a_i e_i)] / Σ 1/(a_i² e_i).
///
/// On GL⁺(3) there is no constraint, and Λ = 0. Each load must be diagonal by itself. If only the sum of the loads is
/// diagonal at the start, the loads may rotate the body later. The caller checks this condition (scene/sector.h).
///
/// This form has three coordinates instead of nine. Its self-gravity does not need an eigenvalue problem, because the
/// axes are known.

#include <cassert>
#include <cmath>

#include "mechanics/core/conservative_system.h"
#include "mechanics/core/second_order_field.h"
#include "reduced/body_of_stages.h"
#include "reduced/pseudo_rigid_body.h"

namespace pseudorigid::reduced {

template <class Body>
class DiagonalBody {
 public:
  using Vector = Eigen::Vector3d;
  using Multiplier = typename Body::Multiplier;
  using Workspace = typename Body::Workspace;
  static constexpr int n_constraints = Body::n_constraints;

  explicit DiagonalBody(Body body) : body_(std::move(body)), e_(body_.E0().diagonal()) {}

  bool time_dependent() const { return mechanics::time_dependent(body_); }
  bool velocity_dependent() const { return mechanics::velocity_dependent(body_); }

  /// Sets f to the force −∂V/∂a. Fails if the force of the body fails. The force of the body must be diagonal.
  mechanics::Status force(double t, const Vector& a, const Vector& adot, Workspace& w, Vector& f) const {
    Eigen::Matrix3d F = Eigen::Matrix3d::Zero();
    if (mechanics::Status status = body_.force(t, a.asDiagonal(), adot.asDiagonal(), w, F); !status) return status;
    assert(F.isDiagonal(0));
    f = F.diagonal();
    return {};
  }
  /// Solves the stages of a Gauss step in lanes, and sets stages.converged (mechanics/core/stage_by_stage.h). Returns
  /// false and does nothing if the lanes cannot compute the self-gravity accurately.
  bool solve_stages_in_lanes(mechanics::GaussStages& stages) const requires(Body::knows_stages) {
    const Eigen::Map<const Vector> a(stages.q);
    if (!takes_gravity_in_lanes(body_.of_stages(), a.asDiagonal())) return false;
    solve_stages_of_body(body_.of_stages(), BodyEntries::diagonal, nullptr, stages);
    return true;
  }
  double cost_of_iteration() const requires(Body::knows_stages) {
    return reduced::cost_of_iteration(body_.of_stages(), BodyEntries::diagonal);
  }
  void apply_inverse_mass(const Vector& f, Vector& a) const { a = f.cwiseQuotient(e_); }
  void apply_mass(const Vector& v, Vector& f) const { f = v.cwiseProduct(e_); }

  mechanics::Status constraint(const Vector& a, Multiplier& g) const {
    return body_.constraint(Eigen::Matrix3d(a.asDiagonal()), g);
  }
  void constraint_rate(const Vector& a, const Vector& v, Multiplier& r) const {
    if constexpr (n_constraints > 0) r = v.cwiseQuotient(a).sum();
  }
  void constraint_curvature(const Vector& a, const Vector& v, Multiplier& r) const {
    if constexpr (n_constraints > 0) r = -v.cwiseQuotient(a).squaredNorm();
  }
  void add_reaction(const Vector& a, const Multiplier& lambda, Vector& f) const {
    if constexpr (n_constraints > 0) f += lambda * a.cwiseInverse();
  }
  void add_reaction_rate(const Vector& a, const Vector& v, const Multiplier& lambda, Vector& f) const {
    if constexpr (n_constraints > 0) f -= lambda * v.cwiseQuotient(a.cwiseAbs2());
  }
  mechanics::SolveReport solve_gram(const Vector& a1, const Vector& a0, const Multiplier& r, Workspace&,
                                    Multiplier& lambda) const {
    if constexpr (n_constraints > 0) lambda = r / (a1.cwiseProduct(a0).cwiseProduct(e_)).cwiseInverse().sum();
    return {};
  }
  double constraint_tolerance() const { return body_.constraint_tolerance(); }

  Vector make_vector() const { return Vector::Zero(); }
  Multiplier make_multiplier() const { return {}; }
  Workspace make_workspace() const { return {}; }

  double kinetic_energy(const Vector& v) const { return 0.5 * v.cwiseAbs2().dot(e_); }
  double potential_energy(const Vector& a) const { return body_.potential_energy(a.asDiagonal()); }
  /// There are no symmetries, because after rotations of space or of the reference ball, Q is not diagonal. The angular
  /// momentum J and the circulation Z are 0.
  int n_symmetries() const { return 0; }
  void symmetry(int, const Vector&, const Vector&, Vector& da, Vector& dv) const {
    da.setZero();
    dv.setZero();
  }

  const Body& body() const { return body_; }
  static Eigen::Matrix3d matrix(const Vector& a) { return a.asDiagonal(); }
  mechanics::VectorState<Eigen::Matrix3d> motion(const mechanics::VectorState<Vector>& state) const {
    return {state.t, matrix(state.q), matrix(state.v)};
  }
  double dissipated(const mechanics::VectorState<Vector>&) const { return 0; }
  /// The state of this form that has the same time, Q and Q̇ as `motion`.
  static mechanics::VectorState<Vector> state_of(const mechanics::VectorState<Eigen::Matrix3d>& motion) {
    return {motion.t, motion.q.diagonal(), motion.v.diagonal()};
  }

 private:
  Body body_;
  Eigen::Vector3d e_;
};

}  // namespace pseudorigid::reduced
