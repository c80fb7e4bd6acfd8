/// Statements about the pseudo-rigid body beside Oliva's (PHYSICS section 1): angular momentum J and circulation Z as
/// integrals over the ball, their signs and conservation; Dedekind's duality; and the rigid limit, which ties 5.7 to
/// the rigid body of 5.6. Motions are those of the explicit method of order 8, which keeps nothing by its construction.

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "mechanics/core/explicit_multiplier.h"
#include "reduced/samples.h"
#include "support/integrate.h"
#include "support/order_fit.h"
#include "systems/euler_top.h"
#include "systems/mass_distribution.h"

namespace pseudorigid::testing {
namespace {

using mechanics::ExplicitMultiplier;

/// Samples of a motion over t = 5, far from Id.
template <class Body>
std::vector<State<Body>> motion(const Body& body, const State<Body>& start, double end = 5) {
  return integrate_samples(ExplicitMultiplier(body), start, end, 50);
}
/// Largest departures from the values at the start.
struct LargestDepartures {
  double angular_momentum = 0, circulation = 0;
};
template <class Body>
LargestDepartures largest_departures(const Body& body, const std::vector<State<Body>>& states) {
  const auto start = observed(body, states.front());
  LargestDepartures d;
  for (const auto& s : states) {
    const auto o = observed(body, s);
    d.angular_momentum = std::max(d.angular_momentum, (o.angular_momentum - start.angular_momentum).norm());
    d.circulation = std::max(d.circulation, (o.circulation - start.circulation).norm());
  }
  return d;
}

/// "J_i = m̄ε_ijk Q_jA Q̇_kA = ∫ρ(x × ẋ)dV, Z_A = m̄ε_ABC(QᵀQ̇)_CB = ∫ρX × (Fᵀẋ)dV" with x = QX; for the ball, and for a
/// reference ellipsoid X = SY, where J and Z have E₀ in place of m̄.
TEST(Statement_Momenta, AreTheIntegralsOverTheReferenceBody) {
  std::mt19937 generator(58);
  for (int i = 0; i < 20; ++i) {
    const Matrix3d S = i < 10 ? Matrix3d(Matrix3d::Identity()) : random_deformation(generator);
    auto reference = reduced::ReferenceBody::unit_ball();
    reference.E0 = S.determinant() * S * reference.E0 * S.transpose();
    const auto s = random_unimodular_state(generator);
    const auto o = observed(Sl3(Law{1, 0}, reference), s);
    const Vector3d J = S.determinant() * integral_over_ball(1, [&](const Vector3d& Y) -> Vector3d {
                         return (s.q * S * Y).cross(s.v * S * Y);
                       });
    const Vector3d Z = S.determinant() * integral_over_ball(1, [&](const Vector3d& Y) -> Vector3d {
                         return (S * Y).cross(s.q.transpose() * s.v * S * Y);
                       });
    EXPECT_LT((o.angular_momentum - J).norm(), 1e-13 * (1 + J.norm()));
    EXPECT_LT((o.circulation - Z).norm(), 1e-13 * (1 + Z.norm()));
  }
}

/// "A rigid spin ω at Q = Id gives J = Z = 2m̄ω": both signs are those of the spin.
TEST(Statement_Momenta, OfARigidSpin) {
  const Vector3d omega(0.3, -0.7, 1.1);
  const auto o = observed(neo_hookean_sl3(), moving<Sl3>(Matrix3d::Identity(), hat(omega)));
  const double m_bar = 4 * std::numbers::pi / 15;
  EXPECT_LT((o.angular_momentum - 2 * m_bar * omega).norm(), 1e-15);
  EXPECT_LT((o.circulation - 2 * m_bar * omega).norm(), 1e-15);
  EXPECT_NEAR(o.kinetic, m_bar * omega.squaredNorm(), 1e-15);  // ½ω·2m̄ω
}

/// "Conserved spatial angular momentum J and circulation Z", on SL(3) and on GL⁺(3), for E₀ = m̄ Id.
TEST(Statement_Momenta, AreConservedOnSl3AndOnGl3) {
  const auto expect_both_conserved = [](const auto& body, const auto& start) {
    const auto before = observed(body, start);
    ASSERT_GT(std::min(before.angular_momentum.norm(), before.circulation.norm()), 0.5);
    ASSERT_GT((before.angular_momentum - before.circulation).norm(), 0.1) << "two different vectors";
    const auto d = largest_departures(body, motion(body, start));
    EXPECT_LT(d.angular_momentum, 1e-12) << "the method's error at its tolerance 1e-13 (seen 1e-13)";
    EXPECT_LT(d.circulation, 1e-12);
  };
  expect_both_conserved(neo_hookean_sl3(), benchmark_state<Sl3>());
  expect_both_conserved(neo_hookean_gl3(), benchmark_state<Gl3>());
}

/// "Z is conserved only if E₀ ∝ Id": Noether's turns of the reference body are no symmetry of another E₀; those of
/// space are.
TEST(Statement_Momenta, CirculationIsNotConservedForATriaxialReferenceBody) {
  const auto expect_J_alone = [](const auto& body, const auto& start) {
    const auto d = largest_departures(body, motion(body, start));
    EXPECT_LT(d.angular_momentum, 1e-12);
    EXPECT_GT(d.circulation, 1e-2);
  };
  expect_J_alone(Sl3(Law{1, 0}, triaxial_inertia()), benchmark_state<Sl3>());
  expect_J_alone(Gl3(Law{1, 1}, triaxial_inertia()), benchmark_state<Gl3>());
}

/// "Dedekind duality: Q(t) a solution ⇒ Q(t)ᵀ a solution", and J and Z change places: J(Qᵀ) = −Z(Q), Z(Qᵀ) = −J(Q), as
/// a turn ω of the one is the turn −ω of the other.
TEST(Statement_DedekindDuality, TransposedMotionsAreMotions) {
  const auto expect_duality = [](const auto& body, const auto& start) {
    const auto states = motion(body, start), duals = motion(body, transposed(start));
    ASSERT_EQ(states.size(), duals.size());
    for (std::size_t k = 0; k < states.size(); ++k) {
      EXPECT_LT(distance(transposed(states[k]), duals[k]), 1e-10) << "two errors of 1e-11";
      const auto o = observed(body, states[k]), dual = observed(body, transposed(states[k]));
      EXPECT_LT((o.angular_momentum + dual.circulation).norm(), 1e-14);
      EXPECT_LT((o.circulation + dual.angular_momentum).norm(), 1e-14);
    }
    EXPECT_GT(distance(states.back(), duals.back()), 0.1) << "another motion";
  };
  expect_duality(neo_hookean_sl3(), benchmark_state<Sl3>());
  expect_duality(neo_hookean_gl3(), benchmark_state<Gl3>());
}

/// The duality needs E₀ ∝ Id.
TEST(Statement_DedekindDuality, FailsForATriaxialReferenceBody) {
  const Sl3 body(Law{1, 0}, triaxial_inertia());
  const auto start = benchmark_state<Sl3>();
  EXPECT_GT(distance(transposed(motion(body, start, 1).back()), motion(body, transposed(start), 1).back()), 0.01);
}

/// Largest |Q − R| over t ≤ 3 between a body of shear modulus μ that starts as a rigid one and the rigid body with the
/// inertia operator tr(E₀)Id − E₀.
template <class Body>
double distance_from_rigid_body(const Law& law) {
  const auto reference = triaxial_inertia();
  const Vector3d Omega(0.8, -0.5, 1.2);
  constexpr double end = 3;
  constexpr int n = 300;
  const systems::EulerTop<> top({systems::inertia_operator(reference.E0), {}});
  const auto rigid = integrate_samples(top, systems::EulerTop<>::turning(Matrix3d::Identity(), Omega), end, n);
  const Body body(law, reference);
  const ExplicitMultiplier field(body);
  const auto elastic = integrate_samples(field, moving<Body>(Matrix3d::Identity(), hat(Omega)), end, n, 1e-11);
  double largest = 0;
  for (std::size_t k = 0; k < rigid.size(); ++k)
    largest = std::max(largest, (elastic[k].q - systems::EulerTop<>::rotation(rigid[k].q)).norm());
  return largest;
}

/// The limit says something: the rigid motion is no uniform turning.
TEST(Statement_5_7_RigidLimit, TheRigidBodyDoesNotTurnUniformly) {
  const systems::EulerTop<> top({systems::inertia_operator(triaxial_inertia().E0), {}});
  const auto end = integrate(top, systems::EulerTop<>::turning(Matrix3d::Identity(), {0.8, -0.5, 1.2}), 3);
  const Vector3d Omega = systems::EulerTop<>::body_angular_velocity(end.q, end.v);
  EXPECT_GT((Omega - Vector3d(0.8, -0.5, 1.2)).norm(), 0.1) << "Ω moves in the body";
}

/// μ → ∞: Q_t converges to the rotation of Euler's equation AΩ̇ = AΩ × Ω with A = tr(E₀)Id − E₀ (5.6.9, 5.6.16), with
/// the rate 1/μ: the strain ~ ρr²Ω²/μ, once at rest and once as oscillation, changes the inertia by as much.
TEST(Statement_5_7_RigidLimit, MotionsConvergeToTheRigidBodyWithOrderOneInTheCompliance) {
  std::vector<ErrorPoint> incompressible, compressible;
  for (const double mu : {1e2, 4e2, 1.6e3, 6.4e3, 2.56e4}) {
    incompressible.push_back({1 / mu, distance_from_rigid_body<Sl3>(Law{mu, 0})});
    compressible.push_back({1 / mu, distance_from_rigid_body<Gl3>(Law{mu, mu})});
  }
  for (const auto& points : {incompressible, compressible}) {
    EXPECT_LT(points.back().error, 1e-4);
    const auto fit = fit_order(points);
    EXPECT_EQ(fit.n_used, points.size());
    EXPECT_NEAR(fit.order, 1, 0.05);
  }
}

}  // namespace
}  // namespace pseudorigid::testing
