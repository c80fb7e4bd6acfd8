/// Statements of Oliva 5.5 (particles), and the correction of the work of gravity.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "mechanics/core/explicit_multiplier.h"
#include "mechanics/methods/methods.h"
#include "support/dense.h"
#include "support/integrate.h"
#include "support/runs.h"
#include "systems/sample_systems.h"

namespace pseudorigid::testing {

using mechanics::State;
using systems::DoublePendulum, systems::MassPoints;

/// Columns of the first vector of points times those of the second: the spatial metric (u, v) = Σ (u_i, v_i).
double spatial(const Eigen::Matrix3Xd& u, const Eigen::Matrix3Xd& v) { return u.cwiseProduct(v).sum(); }

struct InertiaTensor : ::testing::Test {
  MassPoints points{isolated_points()};
  Eigen::Matrix3Xd X = four_points().q, Z = four_points().v;
  Eigen::Matrix3Xd I(const Eigen::Matrix3Xd& u) const {
    Eigen::Matrix3Xd r = points.make_vector();
    points.apply_mass(u, r);
    return r;
  }
  Eigen::Matrix3Xd I_inverse(const Eigen::Matrix3Xd& u) const {
    Eigen::Matrix3Xd r = points.make_vector();
    points.apply_inverse_mass(u, r);
    return r;
  }
  /// ⟨u, v⟩ = Σ m_i (u_i, v_i), from the kinetic energy by polarisation.
  double kinetic(const Eigen::Matrix3Xd& u, const Eigen::Matrix3Xd& v) const {
    return 0.5 * (points.kinetic_energy(u + v) - points.kinetic_energy(u - v));
  }
};
using Statement_5_30 = InertiaTensor;
using Statement_5_31 = InertiaTensor;

/// "The tensor of inertia is characterized by (I(X), Z) = ⟨X, Z⟩"; it and I⁻¹ are symmetric and positive in both.
TEST_F(Statement_5_30, InertiaTensorRelatesTheTwoMetrics) {
  EXPECT_NEAR(spatial(I(X), Z), kinetic(X, Z), 1e-14);
  EXPECT_NEAR(spatial(I(X), Z), spatial(X, I(Z)), 1e-14);
  EXPECT_NEAR(kinetic(I(X), Z), kinetic(X, I(Z)), 1e-14);
  EXPECT_NEAR(kinetic(I_inverse(X), Z), spatial(X, Z), 1e-14);
  EXPECT_NEAR(spatial(I_inverse(X), Z), spatial(X, I_inverse(Z)), 1e-14);
  EXPECT_GT(kinetic(I(X), X), 0);
  EXPECT_GT(spatial(I_inverse(X), X), 0);
}

/// "𝓕 = μI⁻¹F": the force field's work along u is (F, u) (5.32), and Dq̇/dt = I⁻¹F(q̇).
TEST_F(Statement_5_31, AccelerationIsTheInverseInertiaOfTheForces) {
  const auto s = four_points();
  auto w = points.make_workspace();
  Eigen::Matrix3Xd F = points.make_vector();
  ASSERT_TRUE(points.force(0, s.q, s.v, w, F));
  EXPECT_NEAR(kinetic(I_inverse(F), Z), spatial(F, Z), 1e-14);
  // The acceleration of a motion, by the second difference of RATTLE's positions (exact: its equation of motion).
  const double h = 1e-3;
  const auto r = run<mechanics::Rattle>(points, s, 2 * h, 2, 1);
  ASSERT_TRUE(r.finished());
  const Eigen::Matrix3Xd a = (r.states[2].q - 2 * r.states[1].q + r.states[0].q) / (h * h);
  ASSERT_TRUE(points.force(0, r.states[1].q, s.v, w, F));
  EXPECT_LT((I(a) - F).cwiseAbs().maxCoeff(), 1e-8) << "round-off 1e-16/h²";
}

/// "(a) Σ m_i q̈_i = Σ f_i^ext, (b) Σ m_i q̈_i × (q_i − c) = Σ f_i^ext × (q_i − c) for any c": internal forces, central
/// and opposite, drop out of both.
TEST(Statement_5_5_1, InternalForcesDropOutOfBothMomentumLaws) {
  auto p = isolated_points();
  p.dashpots = {{0, 1, 0.8}, {1, 3, 0.5}};
  p.field = {0.1, -0.4, 0.7};
  p.confinement = 0.6;
  p.central_attraction = 0.9;
  p.center = {0.3, 0.2, -2.1};
  p.drag = 0.2;
  auto only_external = p;
  only_external.gravitational_constant = 0;
  only_external.springs.clear();
  only_external.dashpots.clear();

  const auto s = four_points();
  Eigen::Matrix3Xd total(3, 4), external(3, 4);
  MassPoints::Workspace w;
  ASSERT_TRUE(MassPoints(p).force(0, s.q, s.v, w, total));
  ASSERT_TRUE(MassPoints(only_external).force(0, s.q, s.v, w, external));
  EXPECT_GT((total - external).cwiseAbs().maxCoeff(), 0.1);
  const auto torque = [&](const Eigen::Matrix3Xd& f, const Eigen::Vector3d& c) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int i = 0; i < 4; ++i) sum += Eigen::Vector3d(f.col(i)).cross(Eigen::Vector3d(s.q.col(i) - c));
    return sum;
  };
  EXPECT_LT((total.rowwise().sum() - external.rowwise().sum()).norm(), 1e-14);
  for (const Eigen::Vector3d& c : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(5, -3, 2)})
    EXPECT_LT((torque(total, c) - torque(external, c)).norm(), 1e-13);
}

/// The laws along the motion: an isolated system keeps its momenta, and its centre of mass moves uniformly; in a
/// uniform field the momentum grows by M g t.
TEST(Statement_5_5_1, MomentaOfTheMotionFollowTheExternalForces) {
  auto p = isolated_points();
  p.gravitational_constant = 0.05;  // no close encounters within the time of the test
  const auto start = four_points();
  const double end = 20;
  for (const Eigen::Vector3d& g : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.1, -0.4, 0.7)}) {
    p.field = g;
    const MassPoints points(p);
    const auto r = run<mechanics::Rattle8>(points, start, end, 10, 100);
    ASSERT_TRUE(r.finished()) << r.result.reason;
    const double M = p.masses.sum();
    for (const auto& s : r.states) {
      const Eigen::Vector3d momentum = points.momentum(start.v) + M * g * s.t;
      const Eigen::Vector3d center =
          (points.momentum(start.q) + points.momentum(start.v) * s.t) / M + g * s.t * s.t / 2;
      EXPECT_LT((points.momentum(s.v) - momentum).norm(), 1e-12);
      EXPECT_LT((points.momentum(s.q) / M - center).norm(), 1e-11);
      const Eigen::Vector3d c(5, -3, 2);
      const Eigen::Vector3d change =
          points.angular_momentum(s.q, s.v, c) - points.angular_momentum(start.q, start.v, c);
      if (g.isZero(0)) {
        EXPECT_LT(change.norm(), 1e-12);
      }
    }
  }
}

/// (b) along a motion with torque, about a point c ≠ 0: the angular momentum Σ m_i (q_i − c) × q̇_i grows by the
/// integral of the external forces' moment, written out here; springs, dashpots and attractions between the points act
/// as well.
TEST(Statement_5_5_1, AngularMomentumAboutAnyPointFollowsTheExternalTorque) {
  auto p = isolated_points();
  p.gravitational_constant = 0.05;  // no close encounters within the time of the test
  p.dashpots = {{0, 1, 0.8}, {1, 3, 0.5}};
  p.field = {0.1, -0.4, 0.7};
  p.confinement = 0.6;
  p.central_attraction = 0.2;
  p.center = {0.3, 0.2, -4.1};
  p.drag = 0.2;
  const MassPoints points(p);
  const Eigen::Vector3d c(5, -3, 2);
  const auto torque = [&](const State<MassPoints>& s) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d q = s.q.col(i), v = s.v.col(i), d = q - p.center;
      const Eigen::Vector3d f = p.masses(i) * p.field - p.confinement * d - p.drag * v -
                                p.central_attraction * p.masses(i) / std::pow(d.norm(), 3) * d;
      sum += (q - c).cross(f);
    }
    return sum;
  };
  constexpr int n = 400;
  constexpr double end = 2, h = end / n;  // before a point comes close to the centre
  const mechanics::ExplicitMultiplier field(points);
  const auto states = integrate_samples(field, four_points(), end, n, 1e-13);
  ASSERT_EQ(states.size(), n + 1u);
  Eigen::Vector3d gained = Eigen::Vector3d::Zero();
  for (int k = 0; k <= n; ++k)
    gained += (k == 0 || k == n ? 1.0 : k % 2 == 1 ? 4.0 : 2.0) * h / 3 * torque(states[static_cast<std::size_t>(k)]);
  const Eigen::Vector3d change = points.angular_momentum(states.back().q, states.back().v, c) -
                                 points.angular_momentum(states[0].q, states[0].v, c);
  EXPECT_GT(change.norm(), 1);
  EXPECT_LT((change - gained).norm(), 1e-7) << "Simpson's rule: h⁴/180 times the fourth derivative of the torque";
}

/// The double pendulum in Lagrange form, (5.44) with the right sign and (5.45), for (θ, φ).
struct LagrangePendulum {
  using Vector = Eigen::Vector2d;
  struct Workspace {};
  DoublePendulum::Parameters p;

  Eigen::Matrix2d mass(const Vector& q) const {
    const double mixed = p.m2 * p.l1 * p.l2 * std::cos(q(0) - q(1));
    return (Eigen::Matrix2d() << (p.m1 + p.m2) * p.l1 * p.l1, mixed, mixed, p.m2 * p.l2 * p.l2).finished();
  }
  mechanics::Status acceleration(double, const Vector& q, const Vector& v, Workspace&, Vector& a) const {
    const double turning = p.m2 * p.l1 * p.l2 * std::sin(q(0) - q(1));
    const Vector rhs(-turning * v(1) * v(1) - (p.m1 + p.m2) * p.g * p.l1 * std::sin(q(0)),
                     turning * v(0) * v(0) - p.m2 * p.g * p.l2 * std::sin(q(1)));
    a = mass(q).inverse() * rhs;
    return {};
  }
  Vector make_vector() const { return Vector::Zero(); }
  Workspace make_workspace() const { return {}; }
};

/// "R₂ = ρ(q₂ − q₁), R₁ + R₂ = αq₁" is d'Alembert's principle: the reactions of the motion do no work along velocities
/// that the constraints allow (5.41).
TEST(Statement_5_5_2, ReactionsDoNoVirtualWork) {
  const DoublePendulum pendulum(generic_pendulum);
  const auto s = swinging(pendulum);
  auto w = pendulum.make_workspace();
  auto lambda = pendulum.make_multiplier();
  ASSERT_TRUE(mechanics::multiplier_of_motion(pendulum, s, w, lambda));
  Eigen::Vector4d R = Eigen::Vector4d::Zero(), q, v;
  pendulum.add_reaction(s.q, lambda, R);
  const Eigen::Vector2d R1 = R.head<2>(), R2 = R.tail<2>(), q1 = s.q.head<2>(), rod = s.q.tail<2>() - s.q.head<2>();
  const auto area = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a(0) * b(1) - a(1) * b(0); };
  EXPECT_NEAR(area(R2, rod), 0, 1e-15);
  EXPECT_NEAR(area(R1 + R2, q1), 0, 1e-15);
  EXPECT_GT(R1.norm() * R2.norm(), 0.1);
  Eigen::Vector2d angles, rates;
  pendulum.to_angles(s.q, s.v, angles, rates);
  for (const Eigen::Vector2d& virtual_rates : {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)}) {
    pendulum.from_angles(angles, virtual_rates, q, v);
    EXPECT_NEAR(R.dot(v), 0, 1e-15);
  }
}

/// (5.37)–(5.43): with I μ⁻¹R = (R₁, R₂) the work of the reactions along any (u₁, u₂), allowed or not, is
/// R(q̇)(u) = μ(q̈)(u) − F(q̇)(u) = R₁·u₁ + R₂·u₂, the spatial metric. The pairing ⟨(R₁, R₂), (u₁, u₂)⟩ of the kinetic
/// energy would weight it with the masses once more; the book has ⟨I⁻¹(R₁, R₂), (u₁, u₂)⟩, which is right.
TEST(Statement_5_5_2, ReactionsArePairedBySpatialMetric) {
  const DoublePendulum pendulum(generic_pendulum);
  const auto s = swinging(pendulum);
  auto w = pendulum.make_workspace();
  auto lambda = pendulum.make_multiplier();
  ASSERT_TRUE(mechanics::multiplier_of_motion(pendulum, s, w, lambda));
  Eigen::Vector4d R = Eigen::Vector4d::Zero(), F, a, mu_a, kinetic;
  pendulum.add_reaction(s.q, lambda, R);
  const mechanics::ExplicitMultiplier motion(pendulum);
  auto w_motion = motion.make_workspace();
  ASSERT_TRUE(motion.acceleration(0, s.q, s.v, w_motion, a));
  ASSERT_TRUE(pendulum.force(0, s.q, s.v, w, F));
  pendulum.apply_mass(a, mu_a);
  pendulum.apply_mass(R, kinetic);
  const Eigen::Vector4d u(0.9, -2.4, 1.5, 2.1);
  const double work = (mu_a - F).dot(u);
  EXPECT_GT(std::abs(work), 0.1);
  EXPECT_NEAR(R.dot(u), work, 1e-14);
  EXPECT_GT(std::abs(kinetic.dot(u) - work), 0.1);
}

/// "(5.33)–(5.43)" and "(5.44), (5.45)" have the same motions: 1e-10 over t = 20, energy to 1e-12.
TEST(Statement_5_5_2, MultiplierFormAndLagrangeFormAgree) {
  const DoublePendulum pendulum(generic_pendulum);
  const auto start = swinging(pendulum);
  Eigen::Vector2d angles, rates;
  pendulum.to_angles(start.q, start.v, angles, rates);
  const int n = 20;
  const auto r = run<mechanics::Rattle8>(pendulum, start, 20, n, 20);
  ASSERT_TRUE(r.finished()) << r.result.reason;
  const auto lagrange = integrate_samples(LagrangePendulum{generic_pendulum}, {0, angles, rates}, 20, n, 1e-14);
  const auto energy = [&](const State<DoublePendulum>& s) {
    return pendulum.kinetic_energy(s.v) + pendulum.potential_energy(s.q);
  };
  for (std::size_t k = 0; k <= n; ++k) {
    const auto& s = r.states[k];
    Eigen::Vector4d q, v;
    pendulum.from_angles(lagrange[k].q, lagrange[k].v, q, v);
    EXPECT_LT((s.q - q).norm(), 1e-10);
    EXPECT_LT((s.v - v).norm(), 1e-10);
    EXPECT_NEAR(energy(s), energy(start), 1e-12);
    Eigen::Vector2d g;
    ASSERT_TRUE(pendulum.constraint(s.q, g));
    EXPECT_LT(g.norm(), 1e-15);
  }
  EXPECT_GT((r.last().q - start.q).norm(), 0.1);
}

/// "The determinant is m₁m₂l₁²l₂² + m₂²l₁²l₂² sin²(θ − φ)": that of the kinetic energy of the constrained motion.
TEST(Statement_5_5_2, DeterminantOfTheMassMatrix) {
  const DoublePendulum pendulum(generic_pendulum);
  const auto& p = generic_pendulum;
  const Eigen::Vector2d angles(0.7, -1.1);
  const auto kinetic = [&](const Eigen::Vector2d& rates) {
    Eigen::Vector4d q, v;
    pendulum.from_angles(angles, rates, q, v);
    return pendulum.kinetic_energy(v);
  };
  const double g11 = 2 * kinetic({1, 0}), g22 = 2 * kinetic({0, 1}), g12 = kinetic({1, 1}) - (g11 + g22) / 2;
  const double s = std::sin(angles(0) - angles(1)), l = p.l1 * p.l2;
  EXPECT_NEAR(g11 * g22 - g12 * g12, p.m1 * p.m2 * l * l + p.m2 * p.m2 * l * l * s * s, 1e-14);
  EXPECT_NEAR(LagrangePendulum{p}.mass(angles).determinant(), g11 * g22 - g12 * g12, 1e-14);
}

/// "One has 4 critical configurations on the torus", with the Morse indices 0, 1, 1, 2: there the reactions carry the
/// weights, and the Hessian of U − λ·g on the tangent space has as many negative eigenvalues.
TEST(Statement_5_5_2, FourCriticalPointsWithMorseIndices0112) {
  const DoublePendulum pendulum(generic_pendulum);
  constexpr double up = std::numbers::pi;
  const std::array<std::pair<Eigen::Vector2d, int>, 4> expected{
      {{{0, 0}, 0}, {{0, up}, 1}, {{up, 0}, 1}, {{up, up}, 2}}};
  auto w = pendulum.make_workspace();
  auto lambda = pendulum.make_multiplier();
  for (const auto& [angles, index] : expected) {
    State<DoublePendulum> s{};
    pendulum.from_angles(angles, {0, 0}, s.q, s.v);
    ASSERT_TRUE(mechanics::multiplier_of_motion(pendulum, s, w, lambda));
    Eigen::Vector4d balance;
    ASSERT_TRUE(pendulum.force(0, s.q, s.v, w, balance));
    pendulum.add_reaction(s.q, lambda, balance);
    EXPECT_LT(balance.norm(), 1e-14) << "a critical point";

    Eigen::Matrix<double, 4, 2> tangent;
    Eigen::Matrix2d hessian;
    Eigen::Vector4d q, v;
    for (int i = 0; i < 2; ++i) {
      pendulum.from_angles(angles, Eigen::Vector2d::Unit(i), q, v);
      tangent.col(i) = v;
    }
    for (int i = 0; i < 2; ++i) {  // U is linear: D²(U − λ·g) = −λ·D²g
      Eigen::Vector4d rate = Eigen::Vector4d::Zero();
      pendulum.add_reaction_rate(s.q, tangent.col(i), lambda, rate);
      hessian.col(i) = -tangent.transpose() * rate;
    }
    const Eigen::Vector2d eigenvalues = symmetric_spectrum(hessian).values;
    EXPECT_EQ((eigenvalues.array() < 0).count(), index);
    EXPECT_GT(eigenvalues.cwiseAbs().minCoeff(), 0.1) << "not degenerate";
  }
}

/// Work of gravity: 𝓕(q̇)(u) = (m₁u₁^y + m₂u₂^y)g = −dU(u) with U = −m₁gy₁ − m₂gy₂; the printed x components are not it.
TEST(Correction_2, WorkOfGravityUsesTheYComponents) {
  const DoublePendulum pendulum(generic_pendulum);
  const auto& p = generic_pendulum;
  const auto s = swinging(pendulum);
  const Eigen::Vector4d u(0.3, -0.8, 0.5, 0.7);
  const double minus_dU = -(pendulum.potential_energy(s.q + u) - pendulum.potential_energy(s.q));  // U is linear
  auto w = pendulum.make_workspace();
  Eigen::Vector4d f;
  ASSERT_TRUE(pendulum.force(0, s.q, s.v, w, f));
  const double right = (p.m1 * u(1) + p.m2 * u(3)) * p.g, printed = (p.m1 * u(0) + p.m2 * u(2)) * p.g;
  EXPECT_NEAR(right, minus_dU, 1e-14);
  EXPECT_NEAR(f.dot(u), minus_dU, 1e-14);
  EXPECT_GT(std::abs(printed - minus_dU), 0.5);
}

}  // namespace pseudorigid::testing
