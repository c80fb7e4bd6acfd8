/// The statements of Oliva, Geometric Mechanics, 5.1, 5.3 and 5.4. Those of 5.2 are in tests/systems/jacobi_test.cpp.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "materials/ciarlet_geymonat.h"
#include "mechanics/core/chart_field.h"
#include "mechanics/core/explicit_multiplier.h"
#include "mechanics/sphere_particle.h"
#include "reduced/pseudo_rigid_body.h"
#include "support/integrate.h"
#include "support/reaction.h"
#include "support/surface_curves.h"
#include "systems/double_pendulum.h"
#include "systems/double_pendulum_chart.h"
#include "systems/rigid_body.h"
#include "systems/torus.h"

namespace pseudorigid::testing {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using mechanics::ChartField;
using mechanics::State;
using systems::DoublePendulumChart;

constexpr double pi = std::numbers::pi;
/// Sums of some ten terms of order 1 to 10, evaluated in two ways.
constexpr double round_off = 1e-13;

template <class C>
std::vector<CurveJet> jets_of(const C&) {
  return random_jets({0.2, -pi}, {pi - 0.2, pi}, 50);
}
constexpr DoublePendulumChart pendulum{1.3, 0.7, 0.9, 1.2, 2.1};

template <class C>
std::array<Matrix2d, 2> christoffel(const C& chart, const Vector2d& q) {
  std::array<Matrix2d, 2> Gamma;
  const auto status = mechanics::christoffel_symbols(chart, q, Gamma);
  EXPECT_TRUE(status) << status.reason();
  return Gamma;
}

/// Calls test(chart) for each chart of the core's statements.
template <class Test>
void for_each_chart(const Test& test) {
  test(systems::Sphere{1.7});
  test(systems::TorusSurface{});
  test(SphereParticleChart(SphereParticle{}));
  test(systems::Torus{{3, 1}, 1.3, 0.4, 0.2});
  test(pendulum);
}

/// (5.3): (Dq̇/dt)ᵏ = q̈ᵏ + Γᵏ_ij q̇ⁱq̇ʲ. On the sphere Γ^θ_φφ = −sin θ cos θ, Γ^φ_θφ = cot θ.
TEST(Statement_Eq5_3, ChristoffelSymbolsOfTheSphere) {
  const systems::Sphere sphere{1.7};
  for (const auto& [q, v, a] : jets_of(sphere)) {
    const auto Gamma = christoffel(sphere, q);
    const double s = std::sin(q[0]), c = std::cos(q[0]);
    const Matrix2d of_theta{{0, 0}, {0, -s * c}}, of_phi{{0, c / s}, {c / s, 0}};
    EXPECT_LT((Gamma[0] - of_theta).norm(), round_off);
    EXPECT_LT((Gamma[1] - of_phi).norm(), round_off);
  }
}

/// (5.3) on the torus: Γ^w_uu = (3 + cos w) sin w, Γ^u_wu = −sin w/(3 + cos w).
TEST(Statement_Eq5_3, ChristoffelSymbolsOfTheTorus) {
  const systems::TorusSurface torus;
  for (const auto& [q, v, a] : jets_of(torus)) {
    const auto Gamma = christoffel(torus, q);
    const double s = std::sin(q[0]), rho = 3 + std::cos(q[0]);
    const Matrix2d of_w{{0, 0}, {0, rho * s}}, of_u{{0, -s / rho}, {-s / rho, 0}};
    EXPECT_LT((Gamma[0] - of_w).norm(), round_off);
    EXPECT_LT((Gamma[1] - of_u).norm(), round_off);
  }
}

/// (5.3) on the double pendulum: Γ_θ,φφ = m₂l₁l₂ sin(θ−φ) = −Γ_φ,θθ, the others 0.
TEST(Statement_Eq5_3, ChristoffelSymbolsOfTheDoublePendulum) {
  for (const auto& [q, v, a] : jets_of(pendulum)) {
    const auto Gamma = christoffel(pendulum, q);
    const double s = pendulum.m2 * pendulum.l1 * pendulum.l2 * std::sin(q[0] - q[1]);
    const Matrix2d first_theta{{0, 0}, {0, s}}, first_phi{{-s, 0}, {0, 0}};
    const Matrix2d inverse = pendulum.metric(q).inverse();
    for (int k = 0; k < 2; ++k)
      EXPECT_LT((Gamma[k] - inverse(k, 0) * first_theta - inverse(k, 1) * first_phi).norm(), round_off);
  }
}

/// Exercise 5.1.1: μ(Dq̇/dt) = d/dt ∂K/∂q̇ − ∂K/∂q, for any curve. The right side is that of the definition: p = g q̇ is
/// differentiated along the curve, K at constant q̇.
TEST(Statement_Ex5_1_1, CovariantFormIsLagrangeForm) {
  for_each_chart([](const auto& chart) {
    using C = std::decay_t<decltype(chart)>;
    const ChartField<C> field(chart);
    for (const auto& jet : jets_of(chart)) {
      Vector2d D;
      ASSERT_TRUE(field.covariant_acceleration(jet.q, jet.v, jet.a, D));

      const auto q = taylor(jet);
      const Eigen::Matrix<TimeDual, 2, 2> g = chart.metric(q);
      Vector2d lagrange = Vector2d::Zero();  // d/dt (g_ij q̇ʲ)
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
          lagrange[i] += g(i, j).value().derivatives()[0] * jet.v[j] + g(i, j).value().value() * jet.a[j];
      const auto x = mechanics::independent(jet.q);
      const Eigen::Matrix<mechanics::Dual<double, 2>, 2, 2> g_of_q = chart.metric(x);
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) lagrange -= 0.5 * jet.v[i] * jet.v[j] * g_of_q(i, j).derivatives();

      EXPECT_LT((mechanics::apply_mass(chart, jet.q, D) - lagrange).norm(), round_off * (1 + lagrange.norm()));
    }
  });
}

/// (5.7), (5.20): the motion obeys μ(Dq̇/dt) = F(q̇).
TEST(Statement_Eq5_7, MotionsObeyTheGeneralizedNewtonLaw) {
  for_each_chart([](const auto& chart) {
    const ChartField field(chart);
    auto w = field.make_workspace();
    for (const auto& [q, v, ignored] : jets_of(chart)) {
      Vector2d a, D;
      ASSERT_TRUE(field.acceleration(0, q, v, w, a));
      ASSERT_TRUE(field.covariant_acceleration(q, v, a, D));
      EXPECT_LT((mechanics::apply_mass(chart, q, D) - field.force(0, q, v)).norm(), round_off);
    }
  });
}

/// (5.4), 5.1: μ(v) = ⟨v, ·⟩ is invertible, and μ⁻¹(−dU) = −grad U, i.e. ⟨grad U, w⟩ = dU(w).
TEST(Statement_Eq5_4, MassOperatorIsInvertible) {
  for_each_chart([](const auto& chart) {
    for (const auto& [q, v, a] : jets_of(chart)) {
      Vector2d back;
      const auto status = mechanics::apply_inverse_mass(chart.metric(q), mechanics::apply_mass(chart, q, v), back);
      ASSERT_TRUE(status);
      EXPECT_LT((back - v).norm(), round_off);
    }
  });
}

/// Proposition 5.1.2: E_m = K + U is constant along the motions of a conservative system.
TEST(Statement_5_1_2, EnergyIsConstantOnConservativeMotions) {
  const ChartField field(pendulum);
  const State<ChartField<DoublePendulumChart>> start{0, {2.0, -1.0}, {0.3, 0.5}};
  const double E = field.energy(start.q, start.v);
  for (const auto& state : integrate_samples(field, start, 20, 40))
    EXPECT_NEAR(field.energy(state.q, state.v), E, 1e-11);  // some 10³ steps, each of local error 1e-13

  // The statement is about conservative systems: with drag the energy goes.
  const systems::Torus rough{{3, 1}, 1, 0.1, 0};
  const ChartField with_drag(rough);
  const auto end = integrate(with_drag, State<ChartField<systems::Torus>>{0, {1, 1}, {0.5, 0.2}}, 5);
  EXPECT_LT(with_drag.energy(end.q, end.v), with_drag.energy({1, 1}, {0.5, 0.2}) - 0.01);
}

/// Proposition 5.3.1: E = S + C_v(μ⁻¹F), S the geodesic flow.
TEST(Statement_5_3_1, FieldIsGeodesicFlowPlusVerticalLiftOfTheForce) {
  const ChartField<systems::TorusSurface> geodesics(systems::TorusSurface{});
  const systems::Torus torus{{3, 1}, 1.3, 0.4, 0.2};
  const ChartField field(torus);
  auto w = field.make_workspace();
  auto w_geodesics = geodesics.make_workspace();
  for (const auto& [q, v, ignored] : jets_of(torus)) {
    Vector2d E, S, lift;
    ASSERT_TRUE(field.acceleration(0, q, v, w, E));
    ASSERT_TRUE(geodesics.acceleration(0, q, v, w_geodesics, S));
    ASSERT_TRUE(mechanics::apply_inverse_mass(torus.metric(q), field.force(0, q, v), lift));
    EXPECT_LT((E - S - lift).norm(), round_off);
  }
}

/// Proposition 5.3.1: E_m⁻¹(h) is invariant, i.e. dE_m(E) = 0 everywhere, if F = −dU.
TEST(Statement_5_3_1, EnergyLevelsAreInvariant) {
  const auto derivative_of_energy = [](const auto& chart, const CurveJet& jet) {
    const ChartField field(chart);
    auto w = field.make_workspace();
    Vector2d a;
    EXPECT_TRUE(field.acceleration(0, jet.q, jet.v, w, a));
    // E_m is a function on TQ; the trajectory is (q + τ v, v + τ a) to first order.
    const auto q = taylor({jet.q, jet.v, Vector2d::Zero()});
    const Eigen::Matrix<TimeDual, 2, 2> g = chart.metric(q);
    double dE = chart.potential(q).value().derivatives()[0];
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        dE += 0.5 * g(i, j).value().derivatives()[0] * jet.v[i] * jet.v[j] + g(i, j).value().value() * jet.v[i] * a[j];
    return dE;
  };
  for (const CurveJet& jet : jets_of(pendulum)) {
    EXPECT_NEAR(derivative_of_energy(pendulum, jet), 0, round_off);
    EXPECT_NEAR(derivative_of_energy(SphereParticleChart(SphereParticle{}), jet), 0, round_off);
  }
}

// --- 5.4: perfect holonomic constraints ---

template <class S>
struct Sample {
  S system;
  std::vector<State<S>> states;
};

Sample<SphereParticle> particle_on_sphere() {
  Sample<SphereParticle> sample;
  for (const auto& [angles, v, a] : random_jets({0.3, -3}, {2.8, 3}, 20)) {
    const Vector3d q = SphereParticleChart(sample.system).embedding(angles);
    const Vector3d any(v[0], v[1], a[0]);
    sample.states.push_back({0, q, any - q * q.dot(any) / q.squaredNorm()});
  }
  return sample;
}

/// SO(3) ⊂ GL(3) with E₀ = Id, heavy.
Sample<systems::FixedPointBody> rotations() {
  systems::FixedPointBody::Parameters p;
  p.loads.center = {0.2, -0.1, 0.4};
  p.loads.gravity = {0, 0, -1.1};
  Sample<systems::FixedPointBody> sample{systems::FixedPointBody(p), {}};
  for (const auto& [angles, v, a] : random_jets({-3, -3}, {3, 3}, 20)) {
    const Matrix3d R =
        (Eigen::AngleAxisd(angles[0], Vector3d::UnitZ()) * Eigen::AngleAxisd(angles[1], Vector3d::UnitX()))
            .toRotationMatrix();
    sample.states.push_back(systems::turning(R, {v[0], v[1], a[0]}));
  }
  return sample;
}

using Sl3 = reduced::PseudoRigidBody<materials::CiarletGeymonat, true>;
/// SL(3) ⊂ GL(3) with E₀ = Id, neo-Hookean.
Sample<Sl3> unimodular_matrices() {
  Sample<Sl3> sample{Sl3({1, 0}, {Matrix3d::Identity(), 1}), {}};
  for (const auto& [x, v, a] : random_jets({-0.4, -0.4}, {0.4, 0.4}, 20)) {
    Matrix3d Q, L;
    Q << 1 + x[0], v[0], x[1], 0, 1 + x[1], a[0], 0.2, 0, 1;
    Q /= std::cbrt(Q.determinant());
    L << v[0], a[1], 0.3, x[0], v[1], -0.2, a[0], 0.5, -v[0] - v[1];
    sample.states.push_back({0, Q, Q * L});
  }
  return sample;
}

Sample<systems::DoublePendulum> double_pendulum() {
  Sample<systems::DoublePendulum> sample{systems::DoublePendulum({1.3, 0.7, 0.9, 1.2, 2.1}), {}};
  for (const auto& [q, v, a] : random_jets({-3, -3}, {3, 3}, 20)) {
    auto& state = sample.states.emplace_back();
    sample.system.from_angles(q, v, state.q, state.v);
  }
  return sample;
}

template <class Test>
void for_each_constraint(const Test& test) {
  test(particle_on_sphere());
  test(rotations());
  test(unimodular_matrices());
  test(double_pendulum());
}

/// Checks B(v, v) of the system against a closed form, relative to its size.
template <class S, class Form>
void expect_second_fundamental_form(const Sample<S>& sample, const Form& closed_form) {
  auto w = sample.system.make_workspace();
  auto B = sample.system.make_vector();
  for (const auto& state : sample.states) {
    ASSERT_TRUE(mechanics::second_fundamental_form(sample.system, state.q, state.v, w, B));
    const typename S::Vector expected = closed_form(state.q, state.v);
    ASSERT_GT(expected.norm(), 1e-3);
    EXPECT_LT((B - expected).norm(), round_off * (1 + expected.norm()));
  }
}

/// (5.28) on the sphere: B(v, v) = −|v|² q/R².
TEST(Statement_Eq5_28, SecondFundamentalFormOfTheSphere) {
  const auto sample = particle_on_sphere();
  const double R = sample.system.R;
  expect_second_fundamental_form(
      sample, [&](const Vector3d& q, const Vector3d& v) -> Vector3d { return -v.squaredNorm() / (R * R) * q; });
}

/// (5.28) on SO(3) ⊂ GL(3), E₀ = Id: B = QΩ̂².
TEST(Statement_Eq5_28, SecondFundamentalFormOfTheRotations) {
  expect_second_fundamental_form(rotations(), [](const Matrix3d& Q, const Matrix3d& v) -> Matrix3d {
    const Matrix3d Omega = Q.transpose() * v;
    return Q * Omega * Omega;
  });
}

/// (5.28) on SL(3), E₀ = Id: B = tr((Q⁻¹Q̇)²)|Q⁻¹|⁻²Q⁻ᵀ, the normal part of the second derivative QL² of the curve
/// Q exp(τL) of SL(3).
TEST(Statement_Eq5_28, SecondFundamentalFormOfTheUnimodularMatrices) {
  expect_second_fundamental_form(unimodular_matrices(), [](const Matrix3d& Q, const Matrix3d& v) -> Matrix3d {
    const Matrix3d inverse = Q.inverse(), L = inverse * v;
    return (L * L).trace() / inverse.squaredNorm() * inverse.transpose();
  });
  expect_second_fundamental_form(unimodular_matrices(), [](const Matrix3d& Q, const Matrix3d& v) -> Matrix3d {
    const Matrix3d L = Q.inverse() * v, normal = Q.inverse().transpose().normalized();
    return (Q * L * L).cwiseProduct(normal).sum() * normal;
  });
}

/// (5.24), (5.25): (∇q̇)^T = (μ⁻¹F)^T and μ⁻¹R = (∇q̇)^⊥ − (μ⁻¹F)^⊥ on the motion; μ⁻¹R is orthogonal to TN
/// (d'Alembert).
TEST(Statement_Eq5_24, AccelerationSplitsIntoTangentialForceAndReaction) {
  for_each_constraint([](const auto& sample) {
    const auto& system = sample.system;
    const mechanics::ExplicitMultiplier motion(system);
    auto w = system.make_workspace();
    auto w_motion = motion.make_workspace();
    auto acceleration = system.make_vector(), force = acceleration, a_normal = acceleration, f_normal = acceleration,
         R = acceleration;
    for (const auto& state : sample.states) {
      ASSERT_TRUE(motion.acceleration(0, state.q, state.v, w_motion, acceleration));
      ASSERT_TRUE(system.force(0, state.q, state.v, w, force));
      system.apply_inverse_mass(force, force);
      ASSERT_TRUE(mechanics::normal_part(system, state.q, acceleration, w, a_normal));
      ASSERT_TRUE(mechanics::normal_part(system, state.q, force, w, f_normal));
      ASSERT_TRUE(mechanics::reaction_from_multiplier(system, state, w, R));
      const double scale = 1 + acceleration.norm() + force.norm();

      EXPECT_LT(((acceleration - a_normal) - (force - f_normal)).norm(), round_off * scale);
      EXPECT_NEAR(mechanics::dot(R, state.v), 0, round_off * scale * (1 + R.norm()));
      system.apply_inverse_mass(R, R);
      EXPECT_LT((R - (a_normal - f_normal)).norm(), round_off * scale);
    }
  });
}

/// (5.29): R = μ[B(v, v) − (μ⁻¹F)^⊥] is the reaction Gᵀλ of the multiplier.
TEST(Statement_Eq5_29, ReactionFromSecondFundamentalFormIsThatOfTheMultiplier) {
  for_each_constraint([](const auto& sample) {
    auto w = sample.system.make_workspace();
    auto by_form = sample.system.make_vector(), by_multiplier = by_form;
    for (const auto& state : sample.states) {
      ASSERT_TRUE(mechanics::reaction_from_second_fundamental_form(sample.system, state, w, by_form));
      ASSERT_TRUE(mechanics::reaction_from_multiplier(sample.system, state, w, by_multiplier));
      ASSERT_GT(by_multiplier.norm(), 1e-3);
      EXPECT_LT((by_form - by_multiplier).norm(), round_off * (1 + by_multiplier.norm()));
    }
  });
}

/// (5.29) for one constraint f = 0: λ = −[Hess f(v, v) + ⟨grad f, μ⁻¹F⟩]/|grad f|², here f = ½(|q|²/R² − 1), and
/// R = −(m|v|² − m g z) q/R²: the tension of a rope.
TEST(Statement_Eq5_29, MultiplierOfOneConstraint) {
  const auto sample = particle_on_sphere();
  const SphereParticle& s = sample.system;
  SphereParticle::Workspace w;
  for (const auto& state : sample.states) {
    double lambda = 0;
    ASSERT_TRUE(mechanics::multiplier_of_motion(s, state, w, lambda));
    const Vector3d grad = state.q / (s.R * s.R) / s.m, acceleration(0, 0, -s.gravity);  // grad in the metric m·Id
    const double hess = state.v.squaredNorm() / (s.R * s.R);
    EXPECT_NEAR(lambda, -(hess + s.m * grad.dot(acceleration)) / (s.m * grad.squaredNorm()), round_off * 10);
    Vector3d R;
    ASSERT_TRUE(mechanics::reaction_from_multiplier(s, state, w, R));
    const Vector3d rope = -s.m * (state.v.squaredNorm() - s.gravity * state.q.z()) / (s.R * s.R) * state.q;
    EXPECT_LT((R - rope).norm(), round_off * 10);
  }
}

/// (5.26), Exercise 5.4.1: the motions compatible with a perfect constraint are those of (N, ≪,≫, F_N): the spherical
/// pendulum by its multiplier and in its chart.
TEST(Statement_Ex5_4_1, MultiplierFormIsIntrinsicForm) {
  const SphereParticle particle;
  const SphereParticleChart chart(particle);
  const ChartField intrinsic(chart);
  const mechanics::ExplicitMultiplier constrained(particle);

  const CurveJet start{{1.9, 0.3}, {0.2, 0.8}, Vector2d::Zero()};
  const auto image = [&](const Vector2d& q, const Vector2d& v, Vector3d& x, Vector3d& dx) {
    const auto jet = chart.embedding(taylor({q, v, Vector2d::Zero()}));
    for (int i = 0; i < 3; ++i) {
      x[i] = jet[i].value().value();
      dx[i] = jet[i].value().derivatives()[0];
    }
  };
  State<SphereParticle> state;
  image(start.q, start.v, state.q, state.v);
  const auto by_chart =
      integrate_samples(intrinsic, State<ChartField<SphereParticleChart>>{0, start.q, start.v}, 20, 20);
  const auto by_multiplier = integrate_samples(constrained, state, 20, 20);
  ASSERT_EQ(by_chart.size(), by_multiplier.size());
  for (std::size_t k = 0; k < by_chart.size(); ++k) {
    Vector3d x, dx;
    image(by_chart[k].q, by_chart[k].v, x, dx);
    EXPECT_LT((x - by_multiplier[k].q).norm() + (dx - by_multiplier[k].v).norm(), 1e-11);
  }
}

}  // namespace
}  // namespace pseudorigid::testing
