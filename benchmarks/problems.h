#pragma once
/// The benchmark problems as the program's own systems: each in one or more forms (constrained, explicit multiplier,
/// Lagrange, Euler), which are compared in the same coordinates with the same reference.

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>

#include "materials/ciarlet_geymonat.h"
#include "mechanics/core/explicit_multiplier.h"
#include "problem_data.h"
#include "reduced/potential.h"
#include "reduced/pseudo_rigid_body.h"
#include "systems/double_pendulum.h"
#include "systems/euler_top.h"
#include "systems/mass_distribution.h"
#include "systems/rigid_body.h"

namespace pseudorigid::benchmarks {

using mechanics::State;
using mechanics::Status;

/// A system with the start of its motion, and what is compared: the coordinates of the reference, the energy, the
/// greatest violation of the constraint on the configuration.
template <class System>
struct Form {
  std::string name;  ///< "" where the problem has only this one
  System system;
  State<System> initial;
  std::function<Eigen::VectorXd(const State<System>&)> coordinates;
  std::function<double(const State<System>&)> energy, constraint_error;

  /// The same form of another system with the same vectors.
  template <class Other>
  Form<Other> with(const Other& other) const {
    return {name, other, initial, coordinates, energy, constraint_error};
  }
};

template <class Body>
Form<Body> body_form(const Body& body, double stretch, const std::array<double, 9>& L_by_rows) {
  const Eigen::Matrix3d Q = Eigen::Vector3d(stretch, 1, 1 / stretch).asDiagonal();
  const Eigen::Matrix3d L = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(L_by_rows.data());
  return {"",
          body,
          {0, Q, Q * L},
          [](const auto& s) {
            Eigen::VectorXd x(18);
            x << s.q.transpose().reshaped(), s.v.transpose().reshaped();
            return x;
          },
          [body](const auto& s) { return body.kinetic_energy(s.v) + body.potential_energy(s.q); },
          [](const auto& s) { return std::abs(s.q.determinant() - 1); }};
}

using Sl3 = reduced::PseudoRigidBody<materials::CiarletGeymonat, true>;

inline Form<Sl3> sl3_form() {
  return body_form(Sl3({1, 0}, reduced::ReferenceBody::unit_ball()), sl3::stretch, sl3::L);
}

using GravitatingBody = reduced::PseudoRigidBody<reduced::Potential, true>;

inline Form<GravitatingBody> gravitating_form() {
  const auto ball = reduced::ReferenceBody::unit_ball();
  const reduced::Potential gravity(materials::Fluid{}, ball, {.gravity_constant = std::numbers::inv_pi});
  return body_form(GravitatingBody(gravity, ball), gravitating::stretch, gravitating::L);
}

inline Eigen::VectorXd rotation_and_velocity(const Eigen::Matrix3d& R, const Eigen::Vector3d& Omega) {
  Eigen::VectorXd x(12);
  x << R.transpose().reshaped(), Omega;
  return x;
}

inline Form<systems::FixedPointBody> rigid_body_form() {
  const Eigen::Matrix3d A = Eigen::Vector3d(rigid_body::A.data()).asDiagonal();
  const systems::FixedPointBody body({.E0 = systems::second_moment(A)});
  return {"constrained",
          body,
          systems::turning(Eigen::Matrix3d::Identity(), Eigen::Vector3d(rigid_body::Omega.data())),
          [](const auto& s) {
            return rotation_and_velocity(s.q, systems::FixedPointBody::body_angular_velocity(s.q, s.v));
          },
          [body](const auto& s) { return body.kinetic_energy(s.v); },
          [](const auto& s) { return (s.q.transpose() * s.q - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(); }};
}

inline Form<systems::EulerTop<>> euler_form() {
  const Eigen::Matrix3d A = Eigen::Vector3d(rigid_body::A.data()).asDiagonal();
  const systems::EulerTop<> top({.A = A});
  return {"",
          top,
          systems::EulerTop<>::turning(Eigen::Matrix3d::Identity(), Eigen::Vector3d(rigid_body::Omega.data())),
          [](const auto& s) {
            return rotation_and_velocity(systems::EulerTop<>::rotation(s.q),
                                         systems::EulerTop<>::body_angular_velocity(s.q, s.v));
          },
          [top](const auto& s) { return top.kinetic_energy(s.q, s.v); },
          [](const auto& s) { return std::abs(s.q.norm() - 1); }};
}

inline Form<systems::DoublePendulum> pendulum_form() {
  const systems::DoublePendulum pendulum({});
  State<systems::DoublePendulum> initial;
  pendulum.from_angles({double_pendulum::theta, double_pendulum::phi}, {0, 0}, initial.q, initial.v);
  return {"",
          pendulum,
          initial,
          [](const auto& s) {
            Eigen::VectorXd x(8);
            x << s.q, s.v;
            return x;
          },
          [pendulum](const auto& s) { return pendulum.kinetic_energy(s.v) + pendulum.potential_energy(s.q); },
          [pendulum](const auto& s) {
            Eigen::Vector2d g;
            const Status status = pendulum.constraint(s.q, g);
            return status ? 2 * g.cwiseAbs().maxCoeff() : HUGE_VAL;
          }};
}

/// (5.44), with the right sign, and (5.45) at m = l = g = 1, in the angles q = (θ, φ):
///   2θ̈ + φ̈ cos(θ−φ) + φ̇² sin(θ−φ) + 2 sin θ = 0,   φ̈ + θ̈ cos(θ−φ) − θ̇² sin(θ−φ) + sin φ = 0.
struct LagrangePendulum {
  using Vector = Eigen::Vector2d;
  struct Workspace {};

  Status acceleration(double, const Vector& q, const Vector& v, Workspace&, Vector& a) const {
    const double c = std::cos(q(0) - q(1)), s = std::sin(q(0) - q(1));
    const double r1 = -s * v(1) * v(1) - 2 * std::sin(q(0)), r2 = s * v(0) * v(0) - std::sin(q(1));
    const double inverse_det = 1 / (2 - c * c);
    a << (r1 - c * r2) * inverse_det, (2 * r2 - c * r1) * inverse_det;
    return {};
  }
  Vector make_vector() const { return Vector::Zero(); }
  Workspace make_workspace() const { return {}; }
  bool velocity_dependent() const { return true; }
};

inline Form<LagrangePendulum> lagrange_form() {
  const auto constrained = pendulum_form();
  const auto cartesian = [pendulum = constrained.system](const State<LagrangePendulum>& s) {
    State<systems::DoublePendulum> x;
    pendulum.from_angles(s.q, s.v, x.q, x.v);
    return x;
  };
  return {"angles",
          {},
          {0, {double_pendulum::theta, double_pendulum::phi}, {0, 0}},
          [=](const auto& s) { return constrained.coordinates(cartesian(s)); },
          [=](const auto& s) { return constrained.energy(cartesian(s)); },
          [](const auto&) { return 0.0; }};
}

}  // namespace pseudorigid::benchmarks
