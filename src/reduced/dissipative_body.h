#pragma once
/// The pseudo-rigid body with dissipation: M q̈ = f − ∂R/∂Q̇ + Gᵀλ, and beside it the energy D that dissipation has
/// taken,
///
///   Ḋ = 2R(Q, Q̇),
///
/// written as the velocity of a further coordinate s of unit mass, s̈ = 2R, so that every method integrates D with its
/// own order: q = [Q | (s, 0, 0)ᵀ], v = [Q̇ | (D, 0, 0)ᵀ].

#include "mechanics/constrained_system.h"
#include "mechanics/second_order_field.h"
#include "reduced/dissipation.h"

namespace pseudorigid::reduced {

template <class Body>
class DissipativeBody {
 public:
  using Vector = Eigen::Matrix<double, 3, 4>;
  using Multiplier = typename Body::Multiplier;
  using Workspace = typename Body::Workspace;
  static constexpr int n_constraints = Body::n_constraints;

  DissipativeBody(Body body, const Dissipation& dissipation) : body_(std::move(body)), dissipation_(dissipation) {}

  bool time_dependent() const { return mechanics::time_dependent(body_); }
  bool velocity_dependent() const { return true; }
  bool dissipative() const { return true; }

  mechanics::Status force(double t, const Vector& q, const Vector& v, Workspace& w, Vector& f) const {
    const Eigen::Matrix3d Q = matrix(q), Qdot = matrix(v);
    Eigen::Matrix3d F = Eigen::Matrix3d::Zero();
    if (mechanics::Status status = body_.force(t, Q, Qdot, w, F); !status) return status;
    const double power = dissipation_.add_force(body_.reference(), Q, Qdot, F);
    f << F, power * Eigen::Vector3d::UnitX();
    return {};
  }
  void apply_inverse_mass(const Vector& f, Vector& a) const {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    body_.apply_inverse_mass(matrix(f), A);
    const Eigen::Vector3d last = f.col(3);
    a << A, last;
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
  double dissipated(const mechanics::VectorState<Vector>& state) const { return state.v(0, 3); }
  /// The state of this form that begins with (Q, Q̇).
  static mechanics::VectorState<Vector> state_of(const mechanics::VectorState<Eigen::Matrix3d>& motion) {
    mechanics::VectorState<Vector> state{motion.t, Vector::Zero(), Vector::Zero()};
    state.q.leftCols<3>() = motion.q;
    state.v.leftCols<3>() = motion.v;
    return state;
  }

 private:
  Body body_;
  Dissipation dissipation_;
};

}  // namespace pseudorigid::reduced
