#pragma once
/// Bodies and initial states of the tests, in internal units μ = ρ = r = 1: κ = 5 (PHYSICS section 0).

#include <Eigen/Dense>
#include <cmath>

#include "materials/ciarlet_geymonat.h"
#include "reduced/observe.h"
#include "reduced/pseudo_rigid_body.h"
#include "support/runs.h"

namespace pseudorigid::testing {

using Law = materials::CiarletGeymonat;
using Sl3 = reduced::PseudoRigidBody<Law, true>;
using Gl3 = reduced::PseudoRigidBody<Law, false>;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using mechanics::State;

inline constexpr double kappa = 5;
/// Constants of gravity beside a shear modulus of 1.
inline constexpr double weak_gravity = 0.2, moderate_gravity = 0.3, strong_gravity = 0.4;

inline Sl3 neo_hookean_sl3() { return {Law{1, 0}, reduced::ReferenceBody::unit_ball()}; }
inline Gl3 neo_hookean_gl3() { return {Law{1, 1}, reduced::ReferenceBody::unit_ball()}; }

inline Matrix3d matrix(std::initializer_list<double> rows) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows.begin());
}
inline Matrix3d diagonal(double a, double b, double c) { return Vector3d(a, b, c).asDiagonal(); }
inline Matrix3d rotation_z(double angle) { return Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix(); }
/// (u × ·)
inline Matrix3d hat(const Vector3d& u) { return matrix({0, -u.z(), u.y(), u.z(), 0, -u.x(), -u.y(), u.x(), 0}); }

using BodyState = mechanics::VectorState<Matrix3d>;
/// The state of Qᵀ, the dual motion in Dedekind's sense.
inline BodyState transposed(const BodyState& s) { return {s.t, s.q.transpose(), s.v.transpose()}; }

template <class Body>
State<Body> moving(const Matrix3d& Q, const Matrix3d& Qdot) {
  return {0, Q, Qdot};
}

/// Q₀ = diag(1.3, 1, 1/1.3), Q̇₀ = Q₀L.
template <class Body>
State<Body> benchmark_state() {
  const Matrix3d Q = diagonal(1.3, 1, 1 / 1.3);
  return moving<Body>(Q, Q * matrix({0.2, -0.8, 0.1, 0.6, -0.3, 0.2, 0, -0.1, 0.1}));
}
/// A spheroid of polar axis ℓ at rest.
inline State<Sl3> stretched(double l) {
  return moving<Sl3>(diagonal(1 / std::sqrt(l), 1 / std::sqrt(l), l), Matrix3d::Zero());
}
/// Id, turning at rate 3: flattens and pulsates far from the linear regime.
inline State<Sl3> fast_spin() { return moving<Sl3>(Matrix3d::Identity(), hat({0, 0, 3})); }
/// Id, with a small and a large velocity of trace 0.
inline State<Sl3> small_motion() {
  return moving<Sl3>(Matrix3d::Identity(), matrix({0.01, 0.02, 0, 0, -0.01, 0.03, 0.01, 0, 0}));
}
inline State<Sl3> large_motion() {
  return moving<Sl3>(Matrix3d::Identity(), matrix({1.5, -1, 0.3, 0.6, -2, 0.2, 0.4, -0.1, 0.5}));
}

template <class Body>
mechanics::ReducedObservables observed(const Body& body, const State<Body>& state) {
  typename Body::Workspace workspace;
  mechanics::ReducedObservables o;
  const auto status = reduced::observe(body, state, workspace, {}, o);
  EXPECT_TRUE(status) << status.reason();
  return o;
}

/// Q at the end of a run of order 8 with n steps.
template <class Body>
State<Body> state_at(const Body& body, const State<Body>& initial, double end, long n_steps) {
  const auto r = run<mechanics::Rattle8>(body, initial, end, 1, n_steps);
  EXPECT_TRUE(r.finished()) << r.result.reason;
  return r.last();
}

}  // namespace pseudorigid::testing
