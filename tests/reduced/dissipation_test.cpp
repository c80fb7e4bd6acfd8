/// Objective viscosity and linear drag on the pseudo-rigid body (PHYSICS sections 0, 2 (12), 7.7): the forces, the
/// energy that they take and its balance, what they leave alone, rates of decay.

#include "reduced/dissipation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mechanics/core/explicit_multiplier.h"
#include "mechanics/methods/dormand_prince_8.h"
#include "mechanics/steps/largest_frequency.h"
#include "reduced/dissipative_body.h"
#include "reduced/potentials.h"
#include "reduced/samples.h"
#include "support/integrate.h"
#include "support/order_fit.h"

namespace pseudorigid::testing {
namespace {

using mechanics::ExplicitMultiplier;
using reduced::Dissipation;
using reduced::DissipativeBody;
template <class Body>
using Damped = DissipativeBody<Body>;

constexpr double eta = 0.06, c = 0.3;
constexpr Dissipation viscous{.viscosity = eta}, dragged{.drag = c}, both{.viscosity = eta, .drag = c};

/// Rayleigh's function of a body of any shape, R = η Vol det Q tr d² + ½ c tr(Q̇E₀Q̇ᵀ).
auto rayleigh(const reduced::ReferenceBody& body, const Dissipation& dissipation, const Matrix3d& Q) {
  return [=](const Eigen::Matrix3cd& Qdot) -> std::complex<double> {
    const Eigen::Matrix3cd L = Qdot * Q.inverse(), d = 0.5 * (L + L.transpose());
    return dissipation.viscosity * body.volume * Q.determinant() * (d * d).trace() +
           0.5 * dissipation.drag * (Qdot * body.E0 * Qdot.transpose()).trace();
  };
}

TEST(Dissipation, ForceIsMinusTheDerivativeOfRayleighsFunction) {
  std::mt19937 generator(1);
  for (const auto& reference :
       {reduced::ReferenceBody::unit_ball(), reduced::ReferenceBody::ellipsoid({1.4, 0.9, 0.7})})
    for (const auto& dissipation : {viscous, dragged, both}) {
      const Matrix3d Q = random_deformation(generator), Qdot = random_matrix(generator);
      const auto R = rayleigh(reference, dissipation, Q);
      Matrix3d f = Matrix3d::Identity();
      const double power = dissipation.add_force(reference, Q, Qdot, f);
      const Matrix3d minus_dR = -derivative(R, Qdot);
      EXPECT_LT((f - Matrix3d::Identity() - minus_dR).norm(), 1e-14 * (1 + minus_dR.norm()));
      EXPECT_NEAR(power, 2 * R(Qdot.cast<std::complex<double>>()).real(), 1e-14 * (1 + power));
      EXPECT_NEAR(power, -mechanics::dot(minus_dR, Qdot), 1e-14 * (1 + power));
      EXPECT_GT(power, 0);
    }
  EXPECT_FALSE(Dissipation{}.present());
  EXPECT_TRUE(viscous.present() && dragged.present());
}

/// Per m̄ of the ball: R = (5η/ρr²) det Q tr d².
TEST(Dissipation, ViscosityPerMomentOfTheBall) {
  const auto ball = reduced::ReferenceBody::unit_ball();
  const Matrix3d Q = 2 * Matrix3d::Identity(), Qdot = diagonal(1, -0.5, 0.25);
  Matrix3d f = Matrix3d::Zero();
  const double power = viscous.add_force(ball, Q, Qdot, f), m_bar = ball.E0(0, 0);
  EXPECT_NEAR(power / m_bar, 2 * 5 * eta * 8 * (Qdot / 2).squaredNorm(), 1e-14);
}

/// At rest −D_v f per m̄ is 10η sym + c: γ = 10η + c on motions without volume change, as on all of them.
TEST(Dissipation, LargestRateOfDamping) {
  const auto gamma_of = [](const auto& body, double omega) {
    using Body = std::decay_t<decltype(body)>;
    const Damped<Body> damped(body, both);
    const auto rest = damped.state_of({0, Matrix3d::Identity(), Matrix3d::Zero()});
    typename Body::Workspace w;
    const auto report = mechanics::largest_damping(damped, rest, w, omega, 9);
    EXPECT_TRUE(report.status);
    return report.gamma;
  };
  for (const double omega : {0.0, 3.0, 1e3}) {
    EXPECT_NEAR(gamma_of(neo_hookean_sl3(), omega), 10 * eta + c, 1e-8);
    EXPECT_NEAR(gamma_of(neo_hookean_gl3(), omega), 10 * eta + c, 1e-8);
  }
}

/// E + D at the end less E at the start, E = K + V.
template <class Body>
double imbalance(const Damped<Body>& system, const State<Damped<Body>>& start, const State<Damped<Body>>& end) {
  return observed(system, end).energy() - observed(system, start).energy();
}
template <class Body>
Damped<Body> body_with(const Dissipation& dissipation) {
  return {loaded_body<Body>(Law{1, Body::n_constraints > 0 ? 0.0 : 2.0}, {weak_gravity, generic_quadratic()}),
          dissipation};
}

template <class Body>
class EnergyBalance : public ::testing::Test {};
using BothGroups = ::testing::Types<LoadedSl3, LoadedGl3>;
TYPED_TEST_SUITE(EnergyBalance, BothGroups);

/// K + V + D is constant to the order of RATTLE, 2.
TYPED_TEST(EnergyBalance, ConvergesWithTheOrderOfRattle) {
  for (const auto& dissipation : {viscous, dragged, both}) {
    const auto system = body_with<TypeParam>(dissipation);
    const auto start = system.state_of(benchmark_state<TypeParam>());
    std::vector<ErrorPoint> points;
    for (const long n : {200, 400, 800, 1600}) {
      const auto r = run<mechanics::Rattle>(system, start, 4, 1, n);
      ASSERT_TRUE(r.finished()) << r.result.reason;
      points.push_back({4.0 / static_cast<double>(n), std::abs(imbalance(system, start, r.last()))});
    }
    EXPECT_GT(observed(system, start).kinetic, 0.1);
    EXPECT_NEAR(fit_order(points).order, 2, 0.1);
  }
}

/// ... and to the tolerance 1e-13 of the explicit method, times a factor of the motion; D rises all the time and is
/// about what the body had.
TYPED_TEST(EnergyBalance, HoldsToTheToleranceOfExplicit8) {
  for (const auto& dissipation : {viscous, dragged, both}) {
    const auto system = body_with<TypeParam>(dissipation);
    const auto start = system.state_of(benchmark_state<TypeParam>());
    const auto states = integrate_samples(ExplicitMultiplier(system), start, 10, 50);
    for (std::size_t k = 1; k < states.size(); ++k) {
      EXPECT_LT(std::abs(imbalance(system, start, states[k])), 1e-11);
      EXPECT_GT(system.dissipated(states[k]), system.dissipated(states[k - 1]));
    }
    EXPECT_GT(system.dissipated(states.back()), 0.3 * observed(system, start).kinetic);
  }
}

/// Without a coefficient nothing is taken and the motion is that of the body itself, step by step.
TEST(DissipativeBody, WithoutDissipationIsTheBody) {
  const auto body = elastic_sl3({weak_gravity});
  const Damped<LoadedSl3> system(body, {});
  const auto start = benchmark_state<LoadedSl3>();
  const auto plain = run<mechanics::Rattle>(body, start, 5, 1, 500);
  const auto r = run<mechanics::Rattle>(system, system.state_of(start), 5, 1, 500);
  EXPECT_LT(distance(system.motion(r.last()), plain.last()), 1e-12);
  EXPECT_EQ(system.dissipated(r.last()), 0);
}

/// Viscosity exerts no torque: J to round-off by RATTLE, while Z goes; drag takes both as e^{−ct}, exactly so by the
/// explicit method.
TEST(DissipativeBody, MomentaOfAGravitatingBody) {
  const auto start = benchmark_state<LoadedSl3>();
  const Damped<LoadedSl3> viscous_body(elastic_sl3({weak_gravity}), viscous),
      dragged_body(elastic_sl3({weak_gravity}), dragged);
  const auto r = run<mechanics::Rattle>(viscous_body, viscous_body.state_of(start), 10, 50, 20);
  ASSERT_TRUE(r.finished()) << r.result.reason;
  const auto before = observed(viscous_body, r.states.front());
  for (const auto& s : r.states)
    EXPECT_LT((observed(viscous_body, s).angular_momentum - before.angular_momentum).norm(), 1e-13);
  EXPECT_GT((observed(viscous_body, r.last()).circulation - before.circulation).norm(), 0.1);

  const Damped<LoadedSl3> stiff(elastic_sl3({weak_gravity}), {.viscosity = 1e4});
  const auto creeping = run<mechanics::Rattle>(stiff, stiff.state_of(start), 10, 10, 5);
  ASSERT_TRUE(creeping.finished()) << creeping.result.reason;
  for (const auto& s : creeping.states)
    EXPECT_LT((observed(stiff, s).angular_momentum - before.angular_momentum).norm(), 1e-13);

  for (const auto& s : integrate_samples(ExplicitMultiplier(dragged_body), dragged_body.state_of(start), 5, 20)) {
    const auto o = observed(dragged_body, s);
    EXPECT_LT((o.angular_momentum - std::exp(-c * s.t) * before.angular_momentum).norm(), 1e-11);
    EXPECT_LT((o.circulation - std::exp(-c * s.t) * before.circulation).norm(), 1e-11);
  }
}

/// A spheroid in steady rotation, elastic and gravitating: viscosity leaves it alone, drag brings it to rest.
TEST(DissipativeBody, ViscosityLeavesARigidSpinAlone) {
  const auto body = elastic_sl3({weak_gravity});
  const auto start = spinning_spheroid(body, 0.7);
  const double Omega = steady_spin(body, 0.7);
  const Damped<LoadedSl3> viscous_body(body, viscous), dragged_body(body, dragged);
  for (const auto& s : integrate_samples(ExplicitMultiplier(viscous_body), viscous_body.state_of(start), 10, 20)) {
    EXPECT_LT((viscous_body.motion(s).q - rotation_z(Omega * s.t) * start.q).norm(), 1e-10);
    EXPECT_LT(viscous_body.dissipated(s), 1e-15) << "the square of the error";
  }
  const auto dragged_end = integrate(ExplicitMultiplier(dragged_body), dragged_body.state_of(start), 100);
  EXPECT_LT(dragged_body.motion(dragged_end).v.norm(), 1e-6) << "e^{−ct/2} = 3e-7";
}

/// In the long run viscosity leaves the spheroid that turns steadily with the same J, and drag the ball at rest.
TEST(DissipativeBody, EndsInSteadyRotationOrAtRest) {
  const auto start = benchmark_state<LoadedSl3>();
  const auto body = elastic_sl3({weak_gravity});
  const Damped<LoadedSl3> viscous_body(body, {.viscosity = 0.3}), both_body(body, both);
  const auto end = integrate(ExplicitMultiplier(viscous_body), viscous_body.state_of(start), 100, 1e-12);
  const auto o = observed(viscous_body, end);
  const double l = o.semi_axes[2], J = o.angular_momentum.norm();
  EXPECT_NEAR(o.semi_axes[0], o.semi_axes[1], 1e-9);
  EXPECT_NEAR(J, 2 * body.m_bar() / l * steady_spin(body, l), 1e-9) << "J = Ω m̄(a₁² + a₂²)";
  EXPECT_LT(l, 0.99);
  const auto still = integrate(ExplicitMultiplier(both_body), both_body.state_of(start), 150, 1e-12);
  EXPECT_LT((observed(both_body, still).semi_axes - Vector3d::Ones()).norm(), 1e-8);
}

/// The motion of ℓ − 1 per ε from rest at 1 ± ε, the even orders in ε taken away.
template <class Body>
std::vector<double> linear_response(const Damped<Body>& system, double end, int n) {
  constexpr double epsilon = 1e-4;
  std::vector<double> response(n + 1, 0.0);
  for (const double side : {1.0, -1.0}) {
    const auto start = system.state_of(stretched(1 + side * epsilon));
    const auto states = integrate_samples(ExplicitMultiplier(system), start, end, n);
    for (int k = 0; k <= n; ++k) response[k] += side * (system.motion(states[k]).q(2, 2) - 1) / (2 * epsilon);
  }
  return response;
}

/// PHYSICS section 7.7: small oscillations decay with δ = 5η/(ρr²) under viscosity and with c/2 under drag, and turn
/// with ω_d² = ω² − δ², ω² = 10 + 16πG/15.
TEST(DissipativeBody, SmallOscillationsDecayAtTheKnownRates) {
  const double omega_squared = 10 + 16 * std::numbers::pi * weak_gravity / 15;
  for (const auto& [dissipation, delta] :
       {std::pair{viscous, 5 * eta}, std::pair{dragged, c / 2}, std::pair{both, 5 * eta + c / 2}}) {
    const Damped<LoadedSl3> system(elastic_sl3({weak_gravity}), dissipation);
    const double omega_d = std::sqrt(omega_squared - delta * delta), end = 6;
    const int n = 60;
    const auto response = linear_response(system, end, n);
    for (int k = 0; k <= n; ++k) {
      const double t = end * k / n;
      const double exact = std::exp(-delta * t) * (std::cos(omega_d * t) + delta / omega_d * std::sin(omega_d * t));
      EXPECT_NEAR(response[k], exact, 1e-7) << "t = " << t << "; of the order ε²";
    }
  }
}

/// The error of Q at the end of RATTLE, from n and 2n steps.
template <class Body>
std::vector<ErrorPoint> differences_of_steps(const Damped<Body>& system, double end) {
  const auto start = system.state_of(benchmark_state<Body>());
  std::vector<Matrix3d> Q;
  std::vector<ErrorPoint> points;
  for (const long n : {20, 40, 80, 160, 320}) {
    const auto r = run<mechanics::Rattle>(system, start, end, 1, n);
    EXPECT_TRUE(r.finished()) << r.result.reason;
    if (!r.finished()) return {};
    Q.push_back(system.motion(r.last()).q);
    if (Q.size() > 1) points.push_back({end / static_cast<double>(n), (Q[Q.size() - 2] - Q.back()).norm()});
  }
  return points;
}

/// η = 10 … 10⁵ are steps of 10 … 10⁵ times the limit 1/γ of a force that is met by iteration, γ = 10η. The order stays
/// 2, and no step fails.
TYPED_TEST(EnergyBalance, ViscosityDoesNotLimitTheStep) {
  for (const double viscosity : {10.0, 163.0, 1e5}) {
    const auto system = body_with<TypeParam>({.viscosity = viscosity});
    EXPECT_NEAR(fit_order(differences_of_steps(system, 2)).order, 2, 0.25) << viscosity;
  }
}

/// An independent solution of a stiff motion: the explicit method with steps below 1/γ.
TYPED_TEST(EnergyBalance, StiffMotionIsThatOfExplicit8) {
  const auto system = body_with<TypeParam>({.viscosity = 10});
  const auto start = system.state_of(benchmark_state<TypeParam>());
  const auto exact = integrate(ExplicitMultiplier(system), start, 2, 1e-11);
  const auto r = run<mechanics::Rattle>(system, start, 2, 1, 400);
  ASSERT_TRUE(r.finished()) << r.result.reason;
  EXPECT_LT((system.motion(r.last()).q - system.motion(exact).q).norm(), 2e-5);
  EXPECT_LT((system.motion(r.last()).v - system.motion(exact).v).norm(), 2e-4);
}

/// An overdamped ball creeps back: ℓ − 1 falls at the rate δ − √(δ² − ω²), δ = 5η, ω² = 10, from the first step on, and
/// without oscillation of Q or Q̇. Steps are 0.3 periods of the pulsation and 500 times 1/γ.
TEST(DissipativeBody, OverdampedBallCreeps) {
  constexpr double viscosity = 163, delta = 5 * viscosity, epsilon = 1e-5;
  const double rate = delta - std::sqrt(delta * delta - 10);
  const Damped<Sl3> system(neo_hookean_sl3(), {.viscosity = viscosity});
  const auto r = run<mechanics::Rattle>(system, system.state_of(stretched(1 + epsilon)), 60, 100, 2);
  ASSERT_TRUE(r.finished()) << r.result.reason;
  for (std::size_t k = 1; k < r.states.size(); ++k) {
    const auto s = system.motion(r.states[k]);
    const double expected = std::exp(-rate * s.t);
    EXPECT_NEAR((s.q(2, 2) - 1) / epsilon, expected, 2e-4) << "t = " << s.t << "; of the order of ε and h²";
    EXPECT_NEAR(s.v(2, 2) / epsilon / -rate, expected, 1e-2) << "t = " << s.t;
  }
}

/// Compositions take some substeps backwards in time, and conserving methods have nothing to conserve.
TEST(DissipativeBody, IsForRattleAndExplicit8Alone) {
  const Damped<LoadedSl3> system(elastic_sl3({weak_gravity}), viscous);
  const auto expect_refusal = [&](const auto& method) {
    const auto status = method.accepts(system);
    EXPECT_FALSE(status) << method.name;
    EXPECT_NE(status.reason().find("explicit-8"), std::string::npos) << "says what to use: " << status.reason();
  };
  expect_refusal(mechanics::Rattle4{});
  expect_refusal(mechanics::Rattle6{});
  expect_refusal(mechanics::Rattle8{});
  expect_refusal(mechanics::Symmetric8{});
  expect_refusal(mechanics::Symmetric12{});
  EXPECT_FALSE(mechanics::EnergyMomentum::fits<Damped<LoadedSl3>>);
  EXPECT_TRUE(mechanics::Rattle::accepts(system));
  EXPECT_TRUE(mechanics::DormandPrince8::accepts(ExplicitMultiplier(system)));
}

}  // namespace
}  // namespace pseudorigid::testing
