/// Statements of Oliva 5.6 on tops: Euler's equation with its Jacobi-elliptic solution, the unstable intermediate axis
/// (5.6.16), the forced motion with a fixed point, heavy and sleeping tops (5.6.17). Each by Euler's equation on
/// quaternions and, where it is a motion, by the constrained body in GL⁺(3).

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "mechanics/core/explicit_multiplier.h"
#include "mechanics/methods/methods.h"
#include "support/integrate.h"
#include "support/runs.h"
#include "systems/free_top.h"
#include "systems/sample_systems.h"

namespace pseudorigid::testing {

using Eigen::Matrix3d, Eigen::Vector3d;
using mechanics::State;
using systems::EulerTop, systems::FixedPointBody, systems::LoadTorque;

/// The free top of moments 2, 3, 4 with K = 1, L² = 6.8: between the separatrix (6) and the stable axis (8).
struct JacobisTop : ::testing::Test {
  FreeTop exact{generic_moments, 1.0, std::sqrt(6.8)};
  FreeTop::Motion start = exact.at(0);
  double end = 100 * 2 * std::numbers::pi / start.Omega.norm();  // 100 revolutions

  void expect_exact(double t, const Matrix3d& R, const Vector3d& Omega, double tolerance) const {
    const auto motion = exact.at(t);
    EXPECT_LT((Omega - motion.Omega).norm(), tolerance);
    EXPECT_LT((R - motion.R).norm(), tolerance);
  }
};
using Statement_5_6_16 = JacobisTop;

/// The closed form satisfies Ṙ = R(Ω×) and AΩ̇ = AΩ × Ω, by differences: the reference is right.
TEST_F(Statement_5_6_16, ClosedFormSolvesEulersEquation) {
  for (const double t : {0.3, 25.0, 70.0}) {
    constexpr double d = 1e-3;
    const auto m = exact.at(t), a = exact.at(t + d), b = exact.at(t - d), aa = exact.at(t + 2 * d),
               bb = exact.at(t - 2 * d);
    const Matrix3d R_rate = (8 * (a.R - b.R) - (aa.R - bb.R)) / (12 * d);
    const Vector3d Omega_rate = (8 * (a.Omega - b.Omega) - (aa.Omega - bb.Omega)) / (12 * d);
    const Vector3d P = generic_moments.cwiseProduct(m.Omega);
    EXPECT_LT((R_rate - m.R * mechanics::cross_matrix(m.Omega)).norm(), 1e-10);
    EXPECT_LT((generic_moments.cwiseProduct(Omega_rate) - P.cross(m.Omega)).norm(), 1e-10);
  }
}

/// "AΩ̇ = AΩ × Ω" by quaternions, 100 revolutions, against Jacobi's solution.
TEST_F(Statement_5_6_16, EulersEquationFollowsJacobisSolution) {
  const EulerTop<> top({generic_moments.asDiagonal(), {}});
  const auto s = integrate(top, EulerTop<>::turning(start.R, start.Omega), end, 1e-15);
  expect_exact(end, EulerTop<>::rotation(s.q), EulerTop<>::body_angular_velocity(s.q, s.v), 1e-11);
}

/// The constrained body in GL⁺(3) by RATTLE of order 8, the same.
TEST_F(Statement_5_6_16, ConstrainedBodyFollowsJacobisSolution) {
  const FixedPointBody body({generic_E0(), {}});
  const auto r = run<mechanics::Rattle8>(body, systems::turning(start.R, start.Omega), end, 100, 100);
  ASSERT_TRUE(r.finished()) << r.result.reason;
  const auto& s = r.last();
  expect_exact(end, s.q, FixedPointBody::body_angular_velocity(s.q, s.v), 1e-11);
  for (const auto& sample : r.states) {
    EXPECT_LT((body.angular_momentum(sample.q, sample.v) - Vector3d(0, 0, std::sqrt(6.8))).norm(), 1e-13);
    EXPECT_NEAR(body.kinetic_energy(sample.v), 1.0, 1e-12);
    EXPECT_LT((sample.q.transpose() * sample.q - Matrix3d::Identity()).norm(), 4e-15);
  }
}

/// The constrained body by its explicit multiplier.
TEST_F(Statement_5_6_16, ExplicitMultiplierFollowsJacobisSolution) {
  const FixedPointBody body({generic_E0(), {}});
  const mechanics::ExplicitMultiplier<FixedPointBody> field(body);
  const auto s0 = systems::turning(start.R, start.Omega);
  const auto s = integrate(field, {s0.t, s0.q, s0.v}, end, 1e-14);
  expect_exact(end, s.q, FixedPointBody::body_angular_velocity(s.q, s.v), 1e-11);
}

/// "Ṗ = P × Ω": the spatial momentum p = RP stays where it is, |P| is constant and P moves.
TEST_F(Statement_5_6_16, MomentumIsConstantInSpaceAndMovesInTheBody) {
  const EulerTop<> top({generic_moments.asDiagonal(), {}});
  const auto s0 = EulerTop<>::turning(start.R, start.Omega);
  double largest = 0;
  for (const auto& s : integrate_samples(top, s0, exact.period(), 40, 1e-14)) {
    const Vector3d p = top.angular_momentum(s.q, s.v), P = EulerTop<>::rotation(s.q).transpose() * p;
    EXPECT_LT((p - Vector3d(0, 0, std::sqrt(6.8))).norm(), 1e-12);
    EXPECT_NEAR(top.kinetic_energy(s.q, s.v), 1.0, 1e-12);
    largest = std::max(largest, (P - generic_moments.cwiseProduct(start.Omega)).norm());
  }
  EXPECT_GT(largest, 1);
}

/// Growth rate of a small quantity between two times: ln(|x(t₂)|/|x(t₁)|)/(t₂ − t₁).
double growth_rate(double x1, double x2, double t1, double t2) { return std::log(std::abs(x2 / x1)) / (t2 - t1); }

/// The intermediate axis is unstable with the rate Ω√((I₂−I₁)(I₃−I₂)/(I₁I₃)); the two others are stable.
TEST(Statement_5_6_16_Axes, IntermediateAxisIsUnstableWithItsRate) {
  const double speed = 1.7;
  const auto& I = generic_moments;
  const double rate = speed * std::sqrt((I(1) - I(0)) * (I(2) - I(1)) / (I(0) * I(2)));
  // Of a perturbation 1e-8 the decaying part is gone by e⁻¹⁰ at t₁ (twice the rate 5/rate), and at t₂ the growing part
  // e¹⁰·1e-8 = 2e-4 is still linear: its square is below the tolerance.
  const double t1 = 5 / rate, t2 = 10 / rate;
  const FixedPointBody body({generic_E0(), {}});
  const EulerTop<> top({generic_moments.asDiagonal(), {}});
  const Vector3d Omega(1e-8, speed, 0);
  const auto samples = integrate_to(top, EulerTop<>::turning(generic_rotation(), Omega), {t1, t2}, 1e-14);
  const auto Omega_1 = [](const auto& s) { return EulerTop<>::body_angular_velocity(s.q, s.v).x(); };
  EXPECT_NEAR(growth_rate(Omega_1(samples[0]), Omega_1(samples[1]), t1, t2) / rate, 1, 1e-3);

  const auto r = run<mechanics::Rattle8>(body, systems::turning(generic_rotation(), Omega), t2, 2, 200);
  ASSERT_TRUE(r.finished());
  const auto component = [&](std::size_t k) {
    return FixedPointBody::body_angular_velocity(r.states[k].q, r.states[k].v).x();
  };
  EXPECT_NEAR(growth_rate(component(1), component(2), t1, t2) / rate, 1, 1e-3);
}

TEST(Statement_5_6_16_Axes, LargestAndSmallestAxisAreStable) {
  const EulerTop<> top({generic_moments.asDiagonal(), {}});
  for (const int axis : {0, 2}) {
    const Vector3d Omega = 1.7 * Vector3d::Unit(axis) + Vector3d::Constant(1e-6);
    for (const auto& s : integrate_samples(top, EulerTop<>::turning(generic_rotation(), Omega), 100, 100, 1e-13))
      EXPECT_LT((EulerTop<>::body_angular_velocity(s.q, s.v) - 1.7 * Vector3d::Unit(axis)).norm(), 1e-5);
  }
}

/// "ṗ = ∫M*ξ × df and Ṗ = P × Ω + ∫ξ × M*⁻¹df" along a forced motion, by the integral of the torque (Simpson's rule).
TEST(Statement_5_6_17, MomentaOfTheForcedMotionWithAFixedPoint) {
  const FixedPointBody body({tilted_E0(), generic_loads()});
  const EulerTop<LoadTorque> top({body.inertia(), {generic_loads()}});
  const auto s0 = EulerTop<LoadTorque>::turning(generic_rotation(), {0.4, -1.2, 0.8});
  const int n = 400;
  const double end = 4, h = end / n;
  const auto samples = integrate_samples(top, s0, end, n, 1e-14);
  Vector3d p_gained = Vector3d::Zero(), P_gained = Vector3d::Zero();
  for (int k = 0; k <= n; ++k) {
    const auto& s = samples[static_cast<std::size_t>(k)];
    const Matrix3d R = top.rotation(s.q);
    const Vector3d Omega = top.body_angular_velocity(s.q, s.v), P = R.transpose() * top.angular_momentum(s.q, s.v);
    Vector3d torque = Vector3d::Zero();  // in space, directly from the places of the loads
    ASSERT_TRUE(
        generic_loads().apply([&](const Vector3d& xi) -> Vector3d { return R * xi; },
                              [&](const Vector3d& xi, const Vector3d& df) { torque += Vector3d(R * xi).cross(df); }));
    const double weight = (k == 0 || k == n ? 1.0 : k % 2 == 1 ? 4.0 : 2.0) * h / 3;
    p_gained += weight * torque;
    P_gained += weight * (P.cross(Omega) + R.transpose() * torque);
  }
  const auto& s = samples.back();
  const Vector3d p = top.angular_momentum(s.q, s.v), p0 = top.angular_momentum(s0.q, s0.v);
  // Simpson's error h⁴/180 · end · |d⁴/dt⁴| with h = 0.01 is about 1e-9 here.
  EXPECT_LT((p - p0 - p_gained).norm(), 1e-8);
  EXPECT_LT((top.rotation(s.q).transpose() * p - generic_rotation().transpose() * p0 - P_gained).norm(), 1e-8);
  EXPECT_GT((p - p0).norm(), 0.1);
}

/// The forced motion is the same by RATTLE on GL⁺(3) and by Euler's equation, to 1e-10.
TEST(Statement_5_6_17, ConstrainedBodyAgreesWithEulersEquation) {
  const FixedPointBody body({tilted_E0(), generic_loads()});
  const EulerTop<LoadTorque> top({body.inertia(), {generic_loads()}});
  const Vector3d Omega(0.4, -1.2, 0.8);
  const int n = 20;
  const auto r = run<mechanics::Rattle8>(body, systems::turning(generic_rotation(), Omega), 20, n, 60);
  const auto samples = integrate_samples(top, EulerTop<LoadTorque>::turning(generic_rotation(), Omega), 20, n, 1e-14);
  ASSERT_TRUE(r.finished()) << r.result.reason;
  const auto energy = [&](const State<FixedPointBody>& s) {
    return body.kinetic_energy(s.v) + body.potential_energy(s.q);
  };
  for (std::size_t k = 0; k <= n; ++k) {
    const auto& s = r.states[k];
    EXPECT_LT((s.q - top.rotation(samples[k].q)).norm(), 1e-10);
    EXPECT_LT((body.body_angular_velocity(s.q, s.v) - top.body_angular_velocity(samples[k].q, samples[k].v)).norm(),
              1e-10);
    EXPECT_NEAR(energy(s), energy(r.states[0]), 1e-11);
  }
}

/// The heavy symmetric top keeps its energy, p_z and P₃ (Lagrange).
TEST(Statement_5_6_17, HeavyTopKeepsItsThreeIntegrals) {
  const HeavyTop parameters;
  const auto body = parameters.body();
  const auto start = systems::turning(generic_rotation(), {0.3, -0.5, 1.5});
  const auto r = run<mechanics::Rattle8>(body, start, 100, 100, 40);
  ASSERT_TRUE(r.finished()) << r.result.reason;
  const auto energy = [&](const State<FixedPointBody>& s) {
    return body.kinetic_energy(s.v) + body.potential_energy(s.q);
  };
  const auto P_3 = [&](const State<FixedPointBody>& s) {
    return (body.inertia() * body.body_angular_velocity(s.q, s.v)).z();
  };
  for (const auto& s : r.states) {
    EXPECT_NEAR(energy(s), energy(start), 1e-10);
    EXPECT_NEAR(body.angular_momentum(s.q, s.v).z(), body.angular_momentum(start.q, start.v).z(), 1e-13);
    EXPECT_NEAR(P_3(s), P_3(start), 1e-13);
  }
}

/// A regular precession of the heavy top: with θ constant, φ̇ solves (I₁−I₃) cosθ φ̇² − I₃ψ̇φ̇ + mgl = 0 in terms of
/// Ω₃ = ψ̇ + φ̇cosθ:  I₁cosθ φ̇² − I₃Ω₃φ̇ + mgl = 0. The axis then goes round the vertical uniformly.
TEST(Statement_5_6_17, HeavyTopPrecessesRegularly) {
  const HeavyTop top;
  const double theta = 0.8, Omega_3 = 2.5, mgl = top.g * top.l;
  const double b = top.I3 * Omega_3, a = top.I1 * std::cos(theta);
  const double rate = 2 * mgl / (b + std::sqrt(b * b - 4 * a * mgl));  // the slow root
  const Matrix3d R0 = Eigen::AngleAxisd(theta, Vector3d::UnitX()).toRotationMatrix();
  const Vector3d Omega(0, rate * std::sin(theta), Omega_3);  // ψ = 0
  const auto s = integrate(top.by_euler(), EulerTop<LoadTorque>::turning(R0, Omega), 20, 1e-14);
  const Vector3d axis = EulerTop<LoadTorque>::rotation(s.q).col(2);
  const Vector3d expected = Eigen::AngleAxisd(rate * 20, Vector3d::UnitZ()) * Vector3d(R0.col(2));
  EXPECT_LT((axis - expected).norm(), 1e-11);
}

/// Growth rate of the tilt of a sleeping top of spin momentum I₃ω₃ that is tilted by 1e-9.
double rate_of_tilt(const HeavyTop& parameters, double spin_momentum, double t1, double t2) {
  const auto top = parameters.by_euler();
  const Matrix3d tilted = Eigen::AngleAxisd(1e-9, Vector3d::UnitX()).toRotationMatrix();
  const auto start = EulerTop<LoadTorque>::turning(tilted, {0, 0, spin_momentum / parameters.I3});
  const auto samples = integrate_to(top, start, {t1, t2}, 1e-15);
  const auto tilt = [](const auto& s) { return EulerTop<LoadTorque>::rotation(s.q).col(2).template head<2>().norm(); };
  return growth_rate(tilt(samples[0]), tilt(samples[1]), t1, t2);
}

/// "The sleeping top is stable iff (I₃ω₃)² > 4I₁mgl": below, a tilt grows with √(4I₁mgl − (I₃ω₃)²)/(2I₁), whose square
/// vanishes at the threshold; above, it stays small.
TEST(Statement_5_6_17, SleepingTopIsStableAboveItsThreshold) {
  const HeavyTop top;
  const double threshold = 4 * top.I1 * top.g * top.l;
  const auto rate_squared = [&](double spin_squared) {
    const double rate = std::sqrt(threshold - spin_squared) / (2 * top.I1);
    const double measured = rate_of_tilt(top, std::sqrt(spin_squared), 6 / rate, 11 / rate);
    EXPECT_NEAR(measured / rate, 1, 1e-3);
    return measured * measured;
  };
  const double below = 0.5 * threshold, close = 0.9 * threshold;
  const double r_below = rate_squared(below), r_close = rate_squared(close);
  const double zero = close + r_close * (close - below) / (r_below - r_close);
  EXPECT_NEAR(zero / threshold, 1, 1e-3) << "the threshold, from the rates below it";

  const Matrix3d tilted = Eigen::AngleAxisd(1e-6, Vector3d::UnitX()).toRotationMatrix();
  const auto start = EulerTop<LoadTorque>::turning(tilted, {0, 0, std::sqrt(1.01 * threshold) / top.I3});
  for (const auto& s : integrate_samples(top.by_euler(), start, 500, 1000, 1e-13)) {
    const Vector3d axis = EulerTop<LoadTorque>::rotation(s.q).col(2);
    ASSERT_LT(axis.head<2>().norm(), 2e-5) << "1 % above: bounded by the start times the inverse frequency, about 10";
  }
}

}  // namespace pseudorigid::testing
