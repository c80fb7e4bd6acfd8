/// The planar double pendulum in Lagrange form (Oliva, Geometric Mechanics, 5.5), and the sign of (5.44).

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "mechanics/core/chart_field.h"
#include "mechanics/core/explicit_multiplier.h"
#include "mechanics/equilibria/chart_landscape.h"
#include "mechanics/equilibria/constrained_landscape.h"
#include "mechanics/equilibria/critical_points.h"
#include "support/integrate.h"
#include "support/round_off.h"
#include "support/surface_curves.h"
#include "systems/double_pendulum.h"
#include "systems/double_pendulum_chart.h"

namespace pseudorigid::testing {
namespace {

using Eigen::Vector2d;
using mechanics::ChartField;
using mechanics::State;
using systems::DoublePendulum;
using systems::DoublePendulumChart;

using std::numbers::pi;
constexpr DoublePendulumChart pendulum{1.3, 0.7, 0.9, 1.2, 2.1};

std::vector<CurveJet> pendulum_jets() { return random_jets({-pi, -pi}, {pi, pi}, 50); }

/// Left sides of (5.44) and (5.45); `term` is that of (5.44) in place of the right φ̇² sin(θ−φ).
Vector2d lagrange_equations(const CurveJet& jet, double term) {
  const auto& [m1, m2, l1, l2, g] = pendulum;
  const auto& [q, v, a] = jet;
  const double s = std::sin(q[0] - q[1]), c = std::cos(q[0] - q[1]);
  return {(m1 + m2) * l1 * l1 * a[0] + m2 * l1 * l2 * (a[1] * c + term) + (m1 + m2) * g * l1 * std::sin(q[0]),
          m2 * l2 * l2 * a[1] + m2 * l1 * l2 * (a[0] * c - v[0] * v[0] * s) + m2 * g * l2 * std::sin(q[1])};
}
double right_term(const CurveJet& jet) { return jet.v[1] * jet.v[1] * std::sin(jet.q[0] - jet.q[1]); }
/// −φ̇(θ̇−φ̇) sin(θ−φ) − φ̇θ̇ sin(θ−φ), as the book prints it.
double printed_term(const CurveJet& jet) {
  const double theta_rate = jet.v[0], phi_rate = jet.v[1], s = std::sin(jet.q[0] - jet.q[1]);
  return -phi_rate * (theta_rate - phi_rate) * s - phi_rate * theta_rate * s;
}

/// q̈ that solves (5.44) and (5.45), as a field.
template <class Term>
struct LagrangeField {
  using Vector = Vector2d;
  struct Workspace {};
  Term term;
  mechanics::Status acceleration(double, const Vector& q, const Vector& v, Workspace&, Vector& a) const {
    const CurveJet at_rest{q, v, Vector2d::Zero()};
    a = -pendulum.metric(q).inverse() * lagrange_equations(at_rest, term(at_rest));
    return {};
  }
  Vector make_vector() const { return Vector::Zero(); }
  Workspace make_workspace() const { return {}; }
};

/// (5.44), (5.45) are (5.20) for the metric of the double pendulum.
TEST(Statement_Eq5_44, LagrangeFormIsChartForm) {
  const ChartField field(pendulum);
  auto w = field.make_workspace();
  for (CurveJet jet : pendulum_jets()) {
    ASSERT_TRUE(field.acceleration(0, jet.q, jet.v, w, jet.a));
    EXPECT_LT(lagrange_equations(jet, right_term(jet)).norm(), round_off);
  }
}

/// Correction 1: the sign in (5.44). The right form keeps E; the printed one makes Ė = 2m₂l₁l₂ θ̇²φ̇ sin(θ−φ).
TEST(Correction_1, PrintedSignOf5_44BreaksEnergy) {
  const auto energy_rate = [](const LagrangeField<double (*)(const CurveJet&)>& field, const CurveJet& jet) {
    LagrangeField<double (*)(const CurveJet&)>::Workspace w;
    Vector2d a;
    EXPECT_TRUE(field.acceleration(0, jet.q, jet.v, w, a));
    // Ė = ⟨Dq̇/dt + grad U, q̇⟩ (5.1.2), with the covariant acceleration of the field's own motion.
    Vector2d D;
    EXPECT_TRUE(ChartField(pendulum).covariant_acceleration(jet.q, jet.v, a, D));
    return jet.v.dot(pendulum.metric(jet.q) * D) + mechanics::potential_differential(pendulum, jet.q).dot(jet.v);
  };
  double largest = 0;
  for (const CurveJet& jet : pendulum_jets()) {
    const auto& [q, v, a] = jet;
    const double printed = 2 * pendulum.m2 * pendulum.l1 * pendulum.l2 * v[0] * v[0] * v[1] * std::sin(q[0] - q[1]);
    EXPECT_NEAR(energy_rate({right_term}, jet), 0, round_off);
    EXPECT_NEAR(energy_rate({printed_term}, jet), printed, round_off);
    largest = std::max(largest, std::abs(printed));
  }
  EXPECT_GT(largest, 0.1);

  // Along a motion: constant by the right form, of order 1 off by the printed one.
  const auto drift = [](auto term) {
    const LagrangeField<decltype(term)> field{term};
    const Vector2d q(1, 0.3), v(0.5, -0.2);
    const auto end = integrate(field, State<LagrangeField<decltype(term)>>{0, q, v}, 10);
    return mechanics::mechanical_energy(pendulum, end.q, end.v) - mechanics::mechanical_energy(pendulum, q, v);
  };
  EXPECT_NEAR(drift(&right_term), 0, 1e-11);
  EXPECT_GT(std::abs(drift(&printed_term)), 0.01);
}

/// 5.5.2: the mass matrix has the determinant m₁m₂l₁²l₂² + m₂²l₁²l₂² sin²(θ−φ) > 0.
TEST(Statement_5_5_2, DeterminantOfTheMassMatrixOfTheChart) {
  const auto& [m1, m2, l1, l2, g] = pendulum;
  for (const auto& [q, v, a] : pendulum_jets()) {
    const double s = std::sin(q[0] - q[1]), ll = l1 * l1 * l2 * l2;
    EXPECT_NEAR(pendulum.metric(q).determinant(), m1 * m2 * ll + m2 * m2 * ll * s * s, round_off);
  }
}

/// 5.5.2: E_m = ½(m₁+m₂)l₁²θ̇² + ½m₂l₂²φ̇² + m₂l₁l₂θ̇φ̇ cos(θ−φ) − (m₁+m₂)gl₁cos θ − m₂gl₂cos φ is that of the points.
TEST(Statement_5_5_2, EnergyInAnglesIsThatOfThePoints) {
  const DoublePendulum points({pendulum.m1, pendulum.m2, pendulum.l1, pendulum.l2, pendulum.gravity});
  for (const auto& [q, v, a] : pendulum_jets()) {
    Eigen::Vector4d x, dx;
    points.from_angles(q, v, x, dx);
    EXPECT_LT((pendulum.embedding(q) - x).norm(), round_off);
    EXPECT_NEAR(mechanics::kinetic_energy(pendulum, q, v), points.kinetic_energy(dx), round_off);
    EXPECT_NEAR(mechanics::potential_energy(pendulum, q), points.potential_energy(x), round_off);
  }
}

/// 5.5.2: four critical points (0,0), (0,π), (π,0), (π,π) with Morse indices 0, 1, 1, 2; in both forms, with the same
/// spectrum in the metric of the kinetic energy.
TEST(Statement_5_5_2, FourCriticalPoints) {
  const DoublePendulum points({pendulum.m1, pendulum.m2, pendulum.l1, pendulum.l2, pendulum.gravity});
  mechanics::CriticalPoints in_chart, constrained;
  ASSERT_TRUE(mechanics::find_critical_points(mechanics::ChartLandscape(pendulum), {}, in_chart));
  ASSERT_TRUE(mechanics::find_critical_points(mechanics::ConstrainedLandscape(points), {.radius = 2.5}, constrained));
  ASSERT_EQ(in_chart.points.size(), 4u);
  ASSERT_EQ(constrained.points.size(), 4u);
  const std::array<Vector2d, 4> places{Vector2d(0, 0), {0, pi}, {pi, 0}, {pi, pi}};
  constexpr std::array<int, 4> indices{0, 1, 1, 2};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto &p = in_chart.points[k], &c = constrained.points[k];
    EXPECT_LT((p.q - places[k]).norm(), 1e-12);
    EXPECT_LT((c.q - pendulum.embedding(places[k])).norm(), 1e-10);
    EXPECT_NEAR(p.V, c.V, 1e-10);
    for (const auto* point : {&p, &c}) {
      EXPECT_EQ(point->morse_index, indices[k]);
      EXPECT_EQ(point->nullity, 0);
      EXPECT_EQ(point->n_unstable, indices[k]);
    }
    // The constrained Hessian is by differences of a constant force: exact but for the multiplier.
    EXPECT_LT((p.hessian_eigenvalues - c.hessian_eigenvalues).norm(), 1e-9);
  }
}

/// 5.5.2: multiplier form (5.43) and Lagrange form (5.44)–(5.45) have the same motions; t = 20 at a non-chaotic energy.
TEST(Statement_5_5_2, MultiplierFormAndLagrangeFormOfTheChartAgree) {
  const DoublePendulum points({pendulum.m1, pendulum.m2, pendulum.l1, pendulum.l2, pendulum.gravity});
  const mechanics::ExplicitMultiplier constrained(points);
  const ChartField field(pendulum);
  const State<ChartField<DoublePendulumChart>> start{0, {0.5, -0.3}, {0.2, 0.4}};
  State<DoublePendulum> x;
  points.from_angles(start.q, start.v, x.q, x.v);
  const auto angles = integrate_samples(field, start, 20, 20, 1e-14);
  const auto positions = integrate_samples(constrained, x, 20, 20, 1e-14);
  ASSERT_EQ(angles.size(), positions.size());
  const double E = field.energy(start.q, start.v);
  for (std::size_t k = 0; k < angles.size(); ++k) {
    Eigen::Vector4d q, v;
    points.from_angles(angles[k].q, angles[k].v, q, v);
    EXPECT_LT((q - positions[k].q).norm() + (v - positions[k].v).norm(), 1e-10);
    EXPECT_NEAR(field.energy(angles[k].q, angles[k].v), E, 1e-12);
    EXPECT_NEAR(points.kinetic_energy(positions[k].v) + points.potential_energy(positions[k].q), E, 1e-12);
  }
}

}  // namespace
}  // namespace pseudorigid::testing
