/// The fused right-hand side of the pseudo-rigid body: (5.120) with its explicit multiplier, and where it fails.

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "mechanics/core/second_order_field.h"
#include "reduced/samples.h"

namespace pseudorigid::testing {

static_assert(mechanics::SecondOrderField<Sl3> && mechanics::SecondOrderField<Gl3>);

/// A state with semi-axes in [⅓, 3] before the scaling to det Q = 1 on SL(3), arbitrary turns, and a velocity that is
/// tangent there.
template <class Body>
State<Body> random_state(std::mt19937& generator) {
  std::uniform_real_distribution<double> entry(-1, 1);
  const auto turn = [&] {
    return Eigen::Quaterniond(entry(generator), entry(generator), entry(generator), entry(generator))
        .normalized()
        .toRotationMatrix();
  };
  Matrix3d Q = turn() *
               diagonal(std::pow(3, entry(generator)), std::pow(3, entry(generator)), std::pow(3, entry(generator))) *
               turn();
  Matrix3d L = Matrix3d::NullaryExpr([&] { return 2 * entry(generator); });
  if constexpr (Body::n_constraints == 1) {
    Q /= std::cbrt(Q.determinant());
    L -= L.trace() / 3 * Matrix3d::Identity();
  }
  return moving<Body>(Q, Q * L);
}

/// Q̈ = M⁻¹[f + Gᵀλ] from the parts of the constrained form.
template <class Body>
Matrix3d acceleration_by_multiplier(const Body& body, const State<Body>& s) {
  typename Body::Workspace w;
  auto lambda = body.make_multiplier();
  Matrix3d a = Matrix3d::Zero();
  EXPECT_TRUE(body.force(0, s.q, s.v, w, a));
  if constexpr (Body::n_constraints == 1) {
    EXPECT_TRUE(mechanics::multiplier_of_motion(body, s, w, lambda));
  }
  body.add_reaction(s.q, lambda, a);
  body.apply_inverse_mass(a, a);
  return a;
}

template <class Body>
void expect_equal_accelerations(const reduced::ReferenceBody& reference, Law law) {
  const Body body(law, reference);
  typename Body::Workspace w;
  std::mt19937 generator(5120);
  for (int i = 0; i < 1000; ++i) {
    const auto s = random_state<Body>(generator);
    const Matrix3d expected = acceleration_by_multiplier(body, s);
    Matrix3d a = Matrix3d::Zero();
    ASSERT_TRUE(body.acceleration(0, s.q, s.v, w, a));
    // Both sums cancel terms of the size |∂V||Q⁻¹|²|Q|² ≲ κ 27² at worst; 1e-15 of that.
    ASSERT_LT((a - expected).norm(), 1e-15 * 5 * 27 * 27) << "state " << i;
  }
}

TEST(RightHandSide, IsTheMultiplierFormOnSl3) {
  expect_equal_accelerations<Sl3>(reduced::ReferenceBody::unit_ball(), Law{1, 0});
}
TEST(RightHandSide, IsTheMultiplierFormOnSl3WithBulkTerm) {
  expect_equal_accelerations<Sl3>(reduced::ReferenceBody::unit_ball(), Law{1, 2});
}
TEST(RightHandSide, IsTheMultiplierFormOnGl3) {
  expect_equal_accelerations<Gl3>(reduced::ReferenceBody::unit_ball(), Law{1, 1});
}
TEST(RightHandSide, IsTheMultiplierFormWithGeneralInertia) {
  expect_equal_accelerations<Sl3>(triaxial_inertia(), Law{1, 0});
  expect_equal_accelerations<Gl3>(triaxial_inertia(), Law{1, 1});
}

/// PHYSICS section 0: λ = [tr((Q⁻¹Q̇)²) + tr(Q⁻¹∂V E₀⁻¹)]/tr(Q⁻¹Q⁻ᵀE₀⁻¹), term by term with Eigen's inverse.
TEST(RightHandSide, IsThePrintedFormula) {
  for (const auto& reference : {reduced::ReferenceBody::unit_ball(), triaxial_inertia()}) {
    const Sl3 body(Law{1, 0}, reference);
    Sl3::Workspace w;
    std::mt19937 generator(1);
    const auto s = random_state<Sl3>(generator);
    const Matrix3d inverse = s.q.inverse(), E0_inverse = reference.E0.inverse(), L = inverse * s.v;
    const Matrix3d dV = reference.volume * (s.q - inverse.transpose());
    const double lambda =
        ((L * L).trace() + (inverse * dV * E0_inverse).trace()) / (inverse * inverse.transpose() * E0_inverse).trace();
    Matrix3d a = Matrix3d::Zero();
    ASSERT_TRUE(body.acceleration(0, s.q, s.v, w, a));
    EXPECT_LT((a - (lambda * inverse.transpose() - dV) * E0_inverse).norm(), 1e-13 * a.norm());
  }
}

/// d²/dt² ln det Q = tr(Q⁻¹Q̈) − tr((Q⁻¹Q̇)²) = 0: the motion stays on SL(3).
TEST(RightHandSide, IsTangentToSecondOrder) {
  const Sl3 body = neo_hookean_sl3();
  Sl3::Workspace w;
  std::mt19937 generator(2);
  for (int i = 0; i < 100; ++i) {
    const auto s = random_state<Sl3>(generator);
    Matrix3d a = Matrix3d::Zero();
    ASSERT_TRUE(body.acceleration(0, s.q, s.v, w, a));
    double second = 0, curvature = 0;
    body.constraint_rate(s.q, a, second);
    body.constraint_curvature(s.q, s.v, curvature);
    ASSERT_NEAR(second + curvature, 0, 1e-15 * s.q.inverse().norm() * a.norm() * 10);
  }
}

template <class Body>
void expect_failures(const Body& body) {
  typename Body::Workspace w;
  const Matrix3d v = Matrix3d::Random();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const Matrix3d& q : {diagonal(1, 1, -1), diagonal(1, 1, 0), diagonal(1, nan, 1), diagonal(1, 1, inf),
                            diagonal(1e200, 1e200, 1), Matrix3d(Matrix3d::Ones())}) {
    Matrix3d a = Matrix3d::Constant(7);
    const auto status = body.acceleration(0, q, v, w, a);
    EXPECT_FALSE(status) << q;
    EXPECT_NE(status.reason().find("det Q"), std::string::npos);
    EXPECT_EQ(a, Matrix3d::Constant(7)) << "a failing right-hand side writes nothing";
  }
}

TEST(RightHandSide, FailsWhereTheBodyIsTurnedInsideOutOrNotFinite) {
  expect_failures(neo_hookean_sl3());
  expect_failures(neo_hookean_gl3());
  expect_failures(Sl3(Law{1, 0}, triaxial_inertia()));
}

TEST(RightHandSide, FailsAtAVelocityThatIsNotFinite) {
  const Sl3 body = neo_hookean_sl3();
  Sl3::Workspace w;
  Matrix3d a = Matrix3d::Zero();
  EXPECT_FALSE(
      body.acceleration(0, Matrix3d::Identity(), diagonal(std::numeric_limits<double>::quiet_NaN(), 0, 0), w, a));
}

/// ln J near 1 is the library's logarithm, on both sides of the switch to it.
TEST(LogNearOne, IsTheLogarithmToRoundOff) {
  for (int i = -4000; i <= 4000; ++i) {
    const double J = 1 + i * 2.5e-7;
    // 1 ulp of the library's value and 1 of the series
    ASSERT_NEAR(materials::log_near_one(J), std::log(J), 3e-16 * std::abs(std::log(J))) << J;
  }
  EXPECT_EQ(materials::log_near_one(2.5), std::log(2.5));
}

}  // namespace pseudorigid::testing
