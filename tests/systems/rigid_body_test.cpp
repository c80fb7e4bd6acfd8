/// The constrained rigid body: derivatives, symmetries, refusals, agreement of its loads with Euler's equation,
/// declared orders.

#include "systems/rigid_body.h"

#include <gtest/gtest.h>

#include "mechanics/methods/methods.h"
#include "support/order_test.h"
#include "systems/conservative_checks.h"
#include "systems/sample_systems.h"

namespace pseudorigid::testing {

using systems::FixedPointBody, systems::FreeBody;

/// Matrices near a rotation, not on the constraints.
template <class Body>
struct Sample {
  typename Body::Vector q, other_q, v;
  typename Body::Multiplier lambda{0.3, -0.7, 1.1, 0.4, -0.2, 0.6};
  Sample() {
    const Eigen::Matrix3d R = generic_rotation();
    v << Eigen::Matrix<double, 3, Body::n_columns>::NullaryExpr(
        [](Eigen::Index i, Eigen::Index j) { return std::sin(static_cast<double>(3 * i + 7 * j + 1)); });
    q.setConstant(0.4);
    q.template leftCols<3>() = R;
    q += 0.05 * v;
    other_q = q + 0.1 * v;
  }
};

template <class Body>
class AnyRigidBody : public ::testing::Test {};
using Bodies = ::testing::Types<FixedPointBody, FreeBody>;
TYPED_TEST_SUITE(AnyRigidBody, Bodies);

template <class Body>
typename Body::Parameters generic_body() {
  return {tilted_E0(), Body::n_columns == 3 ? generic_loads() : generic_loads_about_the_center()};
}

TYPED_TEST(AnyRigidBody, LawOfMotionIsConsistent) {
  ASSERT_TRUE(TypeParam::accepts(generic_body<TypeParam>()));
  const TypeParam body(generic_body<TypeParam>());
  const Sample<TypeParam> s;
  expect_energies_and_force_agree(body, s.q, s.v);
  expect_constraint_derivatives_agree(body, s.q, s.v, s.lambda);
  expect_gram_solve_is_exact(body, s.q, s.other_q, s.lambda);
}

TYPED_TEST(AnyRigidBody, FlatAndLinearBodiesAreRefused) {
  auto p = generic_body<TypeParam>();
  p.E0 = Eigen::Vector3d(1, 2, 0).asDiagonal();
  const auto status = TypeParam::accepts(p);
  EXPECT_FALSE(status);
  EXPECT_NE(status.reason().find("flat or linear"), std::string::npos);
  p.E0 = systems::second_moment(Eigen::Vector3d(1, 1, 2.5).asDiagonal());  // I₃ > I₁ + I₂: no body has these
  EXPECT_FALSE(TypeParam::accepts(p));
  p.E0.setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(TypeParam::accepts(p));
}

TEST(RigidBody, AFreeBodyMustHaveItsCentreOfMassAtTheOrigin) {
  EXPECT_FALSE(FreeBody::accepts({tilted_E0(), generic_loads()}));
}

TEST(RigidBody, SymmetriesAreThoseThatTheLoadsLeave) {
  const Sample<FixedPointBody> fixed;
  const Sample<FreeBody> free;
  const auto check = [&](const auto& body, const auto& s, int n_expected) {
    EXPECT_EQ(body.n_symmetries(), n_expected);
    expect_symmetries_hold(body, s.q, s.v);
  };
  check(FixedPointBody({tilted_E0(), {}}), fixed, 3);
  check(FixedPointBody({tilted_E0(), generic_loads()}), fixed, 0);
  check(HeavyTop{}.body(), fixed, 1);
  check(FixedPointBody({Eigen::Matrix3d::Identity(), {}}), fixed, 3);
  check(FixedPointBody({Eigen::Matrix3d::Identity(), HeavyTop{}.loads()}), fixed, 1);
  check(FreeBody({tilted_E0(), {}}), free, 6);
  systems::BodyLoads weight;
  weight.gravity = {0, 0.3, -1};
  check(FreeBody({tilted_E0(), weight}), free, 3);
  check(FreeBody({tilted_E0(), generic_loads_about_the_center()}), free, 0);
}

TEST(RigidBody, TurnedInsideOutIsAFailure) {
  const FixedPointBody body({tilted_E0(), {}});
  auto g = body.make_multiplier();
  EXPECT_FALSE(body.constraint(-Eigen::Matrix3d::Identity(), g));
}

/// The first accelerations of the two forms agree: R̈ of the constrained body gives AΩ̇ = AΩ × Ω + N.
TEST(RigidBody, MultiplierFormIsEulersEquation) {
  const FixedPointBody body({tilted_E0(), generic_loads()});
  const systems::EulerTop<systems::LoadTorque> top({body.inertia(), {generic_loads()}});
  const Eigen::Vector3d Omega(0.4, -1.2, 0.8);
  const auto s = systems::turning(generic_rotation(), Omega);
  auto w = body.make_workspace();
  auto lambda = body.make_multiplier();
  ASSERT_TRUE(mechanics::multiplier_of_motion(body, s, w, lambda));
  Eigen::Matrix3d a;
  ASSERT_TRUE(body.force(0, s.q, s.v, w, a));
  body.add_reaction(s.q, lambda, a);
  body.apply_inverse_mass(a, a);
  // RᵀR̈ = Ω̂̇ + Ω̂²: the antisymmetric part is Ω̇.
  const Eigen::Vector3d Omega_rate = -0.5 * mechanics::axial_vector(s.q.transpose() * a);

  Eigen::Vector3d N;
  ASSERT_TRUE(top.parameters().torque(0, s.q, Omega, N));
  const Eigen::Matrix3d A = body.inertia();
  EXPECT_LT((A * Omega_rate - ((A * Omega).cross(Omega) + N)).norm(), 1e-14);
  EXPECT_GT(N.norm(), 0.1);
}

TEST(EulerTop, QuaternionsCarryRotationAndAngularVelocity) {
  using Top = systems::EulerTop<>;
  const Eigen::Vector3d Omega(0.4, -1.2, 0.8);
  const auto s = Top::turning(generic_rotation(), Omega);
  EXPECT_LT((Top::rotation(s.q) - generic_rotation()).norm(), 1e-15);
  EXPECT_LT((Top::body_angular_velocity(s.q, s.v) - Omega).norm(), 1e-15);
  const Eigen::Matrix3d R_rate = derivative([&](double t) { return Top::rotation(s.q + t * s.v); });
  EXPECT_LT((R_rate - generic_rotation() * mechanics::cross_matrix(Omega)).norm(), difference_tolerance);
}

TEST(EulerTop, ProjectionRestoresUnitLengthOrFails) {
  const systems::EulerTop<> top({});
  auto s = systems::EulerTop<>::turning(generic_rotation(), {0.4, -1.2, 0.8});
  auto w = top.make_workspace();
  Eigen::Vector4d q = 1.01 * s.q, v = s.v + 0.02 * s.q;
  ASSERT_TRUE(top.project(q, v, w));
  EXPECT_LT((q - s.q).norm() + (v - s.v).norm(), 1e-15);
  q.setZero();
  EXPECT_FALSE(top.project(q, v, w));
  q.setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(top.project(q, v, w));
}

/// The conserving method at a step of a tenth of a revolution: energy and the symmetries' momenta to round-off.
TEST(RigidBody, ConservingMethodKeepsEnergyAndMomentaAtLargeSteps) {
  systems::BodyLoads weight;
  weight.gravity = {0, 0.3, -1};
  for (const auto& loads : {systems::BodyLoads{}, weight}) {
    const FreeBody body({tilted_E0(), loads});
    const auto start = systems::turning(generic_rotation(), {0.6, -0.9, 1.1}, {0.3, 0.1, -0.2}, {0.5, -0.4, 0.2});
    const auto r = run<mechanics::EnergyMomentum>(body, start, 40, 20, 5);
    ASSERT_TRUE(r.finished()) << r.result.reason;
    const auto momentum = [&](const mechanics::State<FreeBody>& s, int i) {
      FreeBody::Vector dq, dv, p;
      body.symmetry(i, s.q, s.v, dq, dv);
      body.apply_mass(s.v, p);
      return p.cwiseProduct(dq).sum();
    };
    const auto energy = [&](const mechanics::State<FreeBody>& s) {
      return body.kinetic_energy(s.v) + body.potential_energy(s.q);
    };
    // 1e-13 of |p| = 5; with the weight the energies grow to the order of 1e3 while they cancel: round-off 1e-12.
    const double tolerance = loads.gravity.isZero(0) ? 5e-13 : 1e-11;
    for (const auto& s : r.states) {
      EXPECT_NEAR(energy(s), energy(start), tolerance);
      for (int i = 0; i < body.n_symmetries(); ++i) EXPECT_NEAR(momentum(s, i), momentum(start, i), tolerance);
    }
    EXPECT_GT((FreeBody::rotation(r.last().q) - FreeBody::rotation(start.q)).norm(), 0.1);
  }
}

template <class Body>
struct BodyFactory {
  using System = Body;
  Body body{generic_body<Body>()};
  const System& system() const { return body; }
  mechanics::State<System> initial() const {
    const Eigen::Vector3d Omega(0.6, -0.9, 1.1);
    if constexpr (Body::n_columns == 3)
      return systems::turning(generic_rotation(), Omega);
    else
      return systems::turning(generic_rotation(), Omega, {0.3, 0.1, -0.2}, {0.5, -0.4, 0.2});
  }
  double end() const { return 2; }
  std::vector<long> step_counts(int order) const {
    if (order == 2) return {80, 160, 320, 640, 1280};
    if (order == 4) return {40, 57, 80, 113, 160, 226};
    if (order == 6) return {20, 24, 28, 34, 40, 48};
    return {12, 14, 17, 20, 24, 28};
  }
  long n_reference_steps() const { return 200; }
};
template <class Body>
using BodyCases = OrderCases<BodyFactory<Body>, OneStep>;
INSTANTIATE_TYPED_TEST_SUITE_P(FixedPointBody, MethodOrder, BodyCases<FixedPointBody>);
INSTANTIATE_TYPED_TEST_SUITE_P(FreeBody, MethodOrder, BodyCases<FreeBody>);

}  // namespace pseudorigid::testing
