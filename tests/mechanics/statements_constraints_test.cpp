/// The statements of Oliva, Geometric Mechanics, 5.4, on perfect holonomic constraints.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "materials/ciarlet_geymonat.h"
#include "mechanics/core/axial_vectors.h"
#include "mechanics/core/chart_field.h"
#include "mechanics/core/explicit_multiplier.h"
#include "mechanics/sphere_particle.h"
#include "reduced/pseudo_rigid_body.h"
#include "support/integrate.h"
#include "support/reaction.h"
#include "support/round_off.h"
#include "support/surface_curves.h"
#include "systems/double_pendulum.h"
#include "systems/rigid_body.h"

namespace pseudorigid::testing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using mechanics::ChartField;
using mechanics::State;

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

/// An inertia without symmetry.
Matrix3d generic_inertia() { return Matrix3d{{1.3, 0.2, -0.1}, {0.2, 0.8, 0.15}, {-0.1, 0.15, 1.1}}; }

/// SO(3) ⊂ GL(3), heavy.
Sample<systems::FixedPointBody> rotations(const Matrix3d& E0 = Matrix3d::Identity()) {
  systems::FixedPointBody::Parameters p;
  p.E0 = E0;
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
/// SL(3) ⊂ GL(3), neo-Hookean.
Sample<Sl3> unimodular_matrices(const Matrix3d& E0 = Matrix3d::Identity()) {
  Sample<Sl3> sample{Sl3({1, 0}, {E0, 1}), {}};
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
  test(rotations(generic_inertia()));
  test(unimodular_matrices());
  test(unimodular_matrices(generic_inertia()));
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

/// (5.28) on SO(3) with any E₀: the free motion has no tangential acceleration, so that B = Q(Ω̂² + Ω̇×) with Euler's
/// AΩ̇ = AΩ × Ω, A = tr(E₀)Id − E₀.
TEST(Statement_Eq5_28, SecondFundamentalFormOfTheRotationsWithAnyInertia) {
  const Matrix3d E0 = generic_inertia(), A = E0.trace() * Matrix3d::Identity() - E0;
  expect_second_fundamental_form(rotations(E0), [&](const Matrix3d& Q, const Matrix3d& v) -> Matrix3d {
    const Matrix3d Omega_hat = Q.transpose() * v;
    const Vector3d Omega(Omega_hat(2, 1), Omega_hat(0, 2), Omega_hat(1, 0));
    const Vector3d rate = A.inverse() * (A * Omega).cross(Omega);
    return Q * (Omega_hat * Omega_hat + mechanics::cross_matrix(rate));
  });
}

/// (5.28) on SL(3) with any E₀: B = tr((Q⁻¹Q̇)²) Q⁻ᵀE₀⁻¹/tr(Q⁻¹Q⁻ᵀE₀⁻¹), the part of QL² along the normal Q⁻ᵀE₀⁻¹ in the
/// metric tr(Q̇E₀Q̇ᵀ).
TEST(Statement_Eq5_28, SecondFundamentalFormOfTheUnimodularMatricesWithAnyInertia) {
  const Matrix3d E0 = generic_inertia();
  expect_second_fundamental_form(unimodular_matrices(E0), [&](const Matrix3d& Q, const Matrix3d& v) -> Matrix3d {
    const Matrix3d L = Q.inverse() * v, N = Q.inverse().transpose() * E0.inverse();
    const auto inner = [&](const Matrix3d& X, const Matrix3d& Y) { return (X * E0 * Y.transpose()).trace(); };
    return inner(Q * L * L, N) / inner(N, N) * N;
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
    const auto jet = chart.embedding(taylor(CurveJet{q, v, Vector2d::Zero()}));
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
