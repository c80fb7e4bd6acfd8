/// The statements of Oliva, Geometric Mechanics, 5.8, on dissipative systems. The equations and the critical points of
/// 5.8.8 are in torus_test.cpp.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "mechanics/equilibria/chart_landscape.h"
#include "mechanics/equilibria/constrained_landscape.h"
#include "mechanics/equilibria/critical_points.h"
#include "mechanics/equilibria/manifold_starts.h"
#include "mechanics/equilibria/phase_distance.h"
#include "mechanics/methods/dormand_prince_8.h"
#include "mechanics/sphere_particle.h"
#include "support/differences.h"
#include "support/integrate.h"
#include "support/surface_curves.h"
#include "systems/mass_points.h"
#include "systems/torus.h"

namespace pseudorigid::testing {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;
using mechanics::ChartField;
using mechanics::ChartLandscape;
using mechanics::CriticalPoints;
using systems::Torus;

using std::numbers::pi;
using TorusState = mechanics::State<ChartField<Torus>>;

CriticalPoints critical_points(const Torus& torus) {
  CriticalPoints found;
  EXPECT_TRUE(mechanics::find_critical_points(ChartLandscape(torus), {}, found));
  EXPECT_EQ(found.points.size(), 4u);
  return found;
}

/// The torus with a drag that depends on the place and is of third degree in the velocity, D(v) = −(c(q) + |v|²) v.
struct CubicDrag : Torus {
  Vector2d dissipation(const Vector2d& q, const Vector2d& v) const {
    return -(0.3 + 0.2 * std::cos(q[0]) + v.dot(metric(q) * v)) * v;
  }
};

/// 5.8: dE_m/dt = ⟨D(q̇), q̇⟩ < 0 along the motions of a dissipative system: the slope of the energy of what the program
/// integrates, by differences, is the power of the friction, written out: −(c + |v|²)|v|², |v|² = ẇ² + (3 + cos w)² u̇².
TEST(Statement_5_8, PowerOfTheDissipation) {
  constexpr double h = 0.001;  // the friction of third degree takes a fast motion in 0.05
  const auto check = [](const auto& torus, const auto& friction) {
    const ChartField field(torus);
    for (const auto& [q, v, ignored] : random_jets({-pi, -pi}, {pi, pi}, 50)) {
      const mechanics::State<std::decay_t<decltype(field)>> start{0, q, v};
      const double slope = first_difference(
          [&](int k) {
            const auto s = integrate(field, start, h * k);
            return field.energy(s.q, s.v);
          },
          h);
      const double rho = 3 + std::cos(q[0]), speed2 = v[0] * v[0] + rho * rho * v[1] * v[1];
      const double power = -friction(q, speed2) * speed2;
      EXPECT_LT(power, 0);
      EXPECT_NEAR(slope, power, 1e-9 * (1 + speed2)) << "round-off 1e-14/h, truncation h⁸E⁽⁹⁾/630";
    }
  };
  check(Torus{{3, 1}, 1.3, 0.4, 0.2}, [](const Vector2d&, double) { return 0.4; });
  check(CubicDrag{}, [](const Vector2d& q, double speed2) { return 0.3 + 0.2 * std::cos(q[0]) + speed2; });
}

/// Remark 5.8.1: "D̃(0_p) = 0 for all p": at rest nothing but −dV acts, and slow motions feel as much less.
TEST(Statement_5_8_1, NoDissipationAtRest) {
  const Torus rough{{3, 1}, 1.3, 0.4, 0.2}, smooth{{3, 1}, 1.3, 0, 0.2};
  for (const auto& [q, v, ignored] : random_jets({-pi, -pi}, {pi, pi}, 20)) {
    const auto friction = [&, q = q](const Vector2d& u) -> Vector2d {
      return ChartField(rough).force(0, q, u) - ChartField(smooth).force(0, q, u);
    };
    EXPECT_EQ(friction(Vector2d::Zero()), Vector2d::Zero());
    EXPECT_LT(friction(1e-3 * v).norm(), 1e-3 * 0.4 * 16.1 * v.norm()) << "c times the largest metric, 4²";
    EXPECT_LT(friction(v).dot(v), 0);
  }
  systems::MassPoints::Parameters p;
  p.masses = Eigen::Vector2d(1, 2);
  p.field = {0.1, -0.4, 0.7};
  auto damped = p;
  damped.dashpots = {{0, 1, 0.8}};
  damped.drag = 0.3;
  const Eigen::Matrix3Xd q{{0.1, 1.2}, {0.4, -0.5}, {0, 0.3}};
  systems::MassPoints::Workspace w;
  Eigen::Matrix3Xd with(3, 2), without(3, 2);
  ASSERT_TRUE(systems::MassPoints(damped).force(0, q, Eigen::Matrix3Xd::Zero(3, 2), w, with));
  ASSERT_TRUE(systems::MassPoints(p).force(0, q, Eigen::Matrix3Xd::Zero(3, 2), w, without));
  EXPECT_EQ(with, without);
}

/// Remark 5.8.2: D = μ⁻¹D̃, and D̃(v) applied to v is ⟨D(v), v⟩: the friction in the covector that the program calls
/// force against its field D in the metric written out.
TEST(Statement_5_8_2, ForceAndFieldDissipateAlike) {
  const CubicDrag rough{};
  const Torus smooth{{3, 1}, 1, 0, 0};
  for (const auto& [q, v, ignored] : random_jets({-pi, -pi}, {pi, pi}, 20)) {
    const double by_force = (ChartField(rough).force(0, q, v) - ChartField(smooth).force(0, q, v)).dot(v);
    const double rho = 3 + std::cos(q[0]);
    const Vector2d D = rough.dissipation(q, v);
    const double by_field = D[0] * v[0] + rho * rho * D[1] * v[1];
    EXPECT_NEAR(by_force, by_field, 1e-13 * (1 + std::abs(by_field)));
    EXPECT_LT(by_field, 0);
  }
}

/// 5.8, in the large: the energy lost along a motion is the work ∫⟨D(v), v⟩dt, by Simpson's rule; and it falls.
TEST(Statement_5_8, EnergyFallsByTheWorkOfTheDissipation) {
  const Torus torus{{3, 1}, 1.3, 0.4, 0};
  const ChartField field(torus);
  constexpr int n = 2000;
  constexpr double end = 10, h = end / n;
  const auto states = integrate_samples(field, TorusState{0, {0.5, 0.3}, {0.4, 0.2}}, end, n);
  ASSERT_EQ(states.size(), n + 1u);
  double work = 0, before = HUGE_VAL;
  for (int k = 0; k <= n; ++k) {
    const auto& s = states[static_cast<std::size_t>(k)];
    const double weight = k == 0 || k == n ? 1 : k % 2 == 1 ? 4 : 2;
    work += weight * h / 3 * s.v.dot(torus.metric(s.q) * torus.dissipation(s.q, s.v));
    EXPECT_LT(field.energy(s.q, s.v), before);
    before = field.energy(s.q, s.v);
  }
  const double lost = before - field.energy(states[0].q, states[0].v);
  EXPECT_LT(lost, -1);
  EXPECT_NEAR(work, lost, 1e-9);  // Simpson: h⁴/180 times the fourth derivative of the power
}

/// Proposition 5.8.3: singular points of a strongly dissipative system are hyperbolic and dim Wᵘ is the Morse index;
/// for any linear dissipation, also one that is not symmetric. The roots of z² + Dz + H = 0 are counted.
TEST(Statement_5_8_3, UnstableDimensionIsTheMorseIndex) {
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int trial = 0; trial < 20; ++trial) {
    const MatrixXd A = MatrixXd::NullaryExpr(2, 2, [&] { return unit(generator); });
    const MatrixXd turn = Eigen::Matrix2d{{0, 1}, {-1, 0}};
    const MatrixXd C = A * A.transpose() + 0.05 * MatrixXd::Identity(2, 2) + 3 * unit(generator) * turn;  // ⟨Cv, v⟩ > 0
    CriticalPoints found;
    const Torus torus{{3, 1}, 1, 0.01, 0.4 * unit(generator)};
    ASSERT_TRUE(mechanics::find_critical_points(ChartLandscape(torus),
                                                {.added_damping = [&](const VectorXd&) { return C; }}, found));
    ASSERT_EQ(found.points.size(), 4u);
    for (const auto& p : found.points) {
      EXPECT_TRUE(p.obeys_5_8_3());
      EXPECT_LE(p.n_unstable, 2);  // (iv): dim Wᵘ ≤ dim Q ≤ dim Wˢ
      EXPECT_GE(p.n_stable, 2);
    }
  }
}

/// 5.8.3 with constraints, and where it needs dissipation: a pumping "drag" moves the roots to the right.
TEST(Statement_5_8_3, HoldsWithConstraintsAndOnlyForDissipation) {
  SphereParticle particle;
  particle.C = Matrix3d{{0.5, 0.2, 0}, {0.2, 0.3, 0.1}, {0, 0.1, 0.4}};
  CriticalPoints found;
  const auto find = [&] {
    ASSERT_TRUE(mechanics::find_critical_points(mechanics::ConstrainedLandscape(particle), {.radius = 3}, found));
    ASSERT_EQ(found.points.size(), 2u);
  };
  find();
  for (const auto& p : found.points) EXPECT_TRUE(p.obeys_5_8_3());
  particle.C = -particle.C;
  find();
  EXPECT_EQ(found.points[0].morse_index, 0);
  EXPECT_EQ(found.points[0].n_unstable, 4);
  EXPECT_FALSE(found.points[0].obeys_5_8_3());
}

/// 5.8.3: the rates are those of the field itself: near the upper saddle the unstable motion grows like e^{zt}.
TEST(Statement_5_8_3, RatesAreThoseOfTheMotion) {
  const Torus torus{{3, 1}, 1, 1, 0};
  const auto found = critical_points(torus);
  const auto& saddle = found.points[2];
  const double z = (-1 + std::sqrt(1 + 4 * 0.5)) / 2;  // z² + cz + H = 0, H = −g/2
  const ChartField field(torus);
  constexpr double epsilon = 1e-5;
  const TorusState start{0, saddle.q + epsilon * Vector2d(0, 1), epsilon * z * Vector2d(0, 1)};
  const TorusState end = integrate(field, start, 5);
  EXPECT_NEAR(std::log((end.q - saddle.q).norm() / epsilon) / 5, z, 5e-9);  // O(ε²) and (error of the steps)/ε
}

/// 5.8.8: w = π is invariant.
TEST(Statement_5_8_8, TheInnerCircleIsInvariant) {
  const ChartField field(Torus{{3, 1}, 1, 1, 0});
  auto work = field.make_workspace();
  for (int k = 0; k < 20; ++k) {
    Vector2d a;
    ASSERT_TRUE(field.acceleration(0, {pi, 0.3 * k}, {0, 0.2 * k - 1}, work, a));
    EXPECT_NEAR(a[0], 0, 1e-14);  // sin of the rounded π is 1.2e-16, times (3 + cos w) u̇²
  }
  const ChartField tilted(Torus{{3, 1}, 1, 1, 0.1});
  Vector2d a;
  ASSERT_TRUE(tilted.acceleration(0, {pi, 0.3}, {0, 0.2}, work, a));
  EXPECT_GT(std::abs(a[0]), 0.05);
}

/// The branch of the upper saddle's unstable manifold that starts at q* + ε δ: how near it comes to the lower saddle,
/// and how far from the sink it is at the end.
struct Connection {
  double miss = std::numeric_limits<double>::infinity(), distance_to_sink = 0;
};
Connection follow(const Torus& torus, double epsilon) {
  using Field = ChartField<Torus>;
  const auto found = critical_points(torus);
  const auto periods = ChartLandscape(torus).periods();
  const auto distance = [&](const mechanics::State<Field>& state, int point) {
    return mechanics::phase_distance(state.q, state.v, found.points[point].q, periods);
  };
  const auto leaving = mechanics::manifold_basis(found.points[2], true).front();
  const Field field(torus);
  mechanics::DormandPrince8Workspace<Field> work(field, 1e-13);
  mechanics::State<Field> state{0, found.points[2].q + epsilon * leaving.q, epsilon * leaving.v};

  Connection connection;
  while (state.t < 200) {
    const auto status = mechanics::DormandPrince8::step(field, 200, state, work);
    EXPECT_TRUE(status) << status.reason();
    if (!status) break;
    connection.miss = std::min(connection.miss, distance(state, 1));
  }
  connection.distance_to_sink = distance(state, 0);
  return connection;
}

Connection follow(double tilt, double epsilon) { return follow(Torus{{3, 1}, 1, 1, tilt}, epsilon); }

/// 5.8.8: the unstable manifold (dimension 1) of the upper saddle lies in the stable manifold of the lower one: both
/// branches come to within 10⁻⁶ of it. They do not come nearer, since there round-off η = 10⁻¹⁶ across the circle grows
/// like e^{z₊t} while the distance falls like e^{−t/2}: at best η^{0.5/(0.5+0.618)} = 7·10⁻⁸.
TEST(Statement_5_8_8, TheInnerCircleConnectsTheSaddles) {
  for (const double epsilon : {1e-6, -1e-6}) EXPECT_LT(follow(0, epsilon).miss, 1e-6);
}

/// 5.8.6: transversality is generic: any tilt breaks the connection. The branch misses the other saddle by a distance
/// that grows with the tilt, and goes to the sink.
TEST(Statement_5_8_6, TiltingBreaksTheConnection) {
  for (const double side : {1.0, -1.0}) {
    double before = 1e-6;  // more than the connection's own distance
    for (const double tilt : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.3}) {
      const Connection broken = follow(tilt, side * 1e-6);
      EXPECT_GT(broken.miss, 1.2 * before) << "tilt " << tilt;
      EXPECT_LT(broken.distance_to_sink, 1e-6);
      before = broken.miss;
    }
    EXPECT_GT(follow(0.01, side * 1e-6).miss, 0.3);
    EXPECT_GT(follow(0.1, side * 1e-6).miss, 1);
  }
}

/// 5.8.6, the other half: with V fixed, the upright torus, a change of D alone breaks the connection. Friction that is
/// greater along a grain e, D(v) = −c (v + β⟨v, e⟩e), pushes a particle that slides along the circle across it unless e
/// is along or across. A friction c(q) v never does.
TEST(Statement_5_8_6, AGrainBreaksTheConnection) {
  const auto with_grain = [](double grain, double angle) {
    Torus torus{{3, 1}, 1, 1, 0};
    torus.grain = grain;
    torus.grain_angle = angle;
    return torus;
  };
  for (const double side : {1.0, -1.0}) {
    double before = 1e-6;
    for (const double grain : {1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.5}) {
      const Connection broken = follow(with_grain(grain, 0.6), side * 1e-6);
      EXPECT_GT(broken.miss, 1.2 * before) << "grain " << grain;
      EXPECT_LT(broken.distance_to_sink, 1e-6);
      before = broken.miss;
    }
    EXPECT_GT(before, 0.5);
    EXPECT_LT(follow(with_grain(0.5, 0), side * 1e-6).miss, 1e-6);
    Torus uneven{{3, 1}, 1, 1, 0};
    uneven.c_w = 0.3;
    uneven.c_u = -0.5;
    EXPECT_LT(follow(uneven, side * 1e-6).miss, 1e-6);
  }
}

/// The grain in the metric: ⟨D(v), v⟩ = −c(q) (|v|² + β⟨v, e⟩²) with e of length 1, so D is dissipative (5.8), and its
/// greatest ratio to |v|², over directions, is c(q)(1 + β).
TEST(Statement_5_8, AGrainDissipates) {
  Torus torus{{3, 1}, 1, 0.7, 0.2};
  torus.grain = 0.8;
  torus.grain_angle = 0.4;
  torus.c_w = 0.3;
  torus.c_u = -0.5;
  for (const auto& [q, v, ignored] : random_jets({-pi, -pi}, {pi, pi}, 50)) {
    const double rho = 3 + std::cos(q[0]), c = 0.7 * (1 + 0.3 * std::cos(q[0]) - 0.5 * std::cos(q[1]));
    const Vector2d along(v[0], rho * v[1]), e(std::cos(0.4), std::sin(0.4));  // in the orthonormal frame
    const double power = torus.dissipation(q, v).dot(torus.metric(q) * v);
    EXPECT_NEAR(power, -c * (along.squaredNorm() + 0.8 * std::pow(along.dot(e), 2)), 1e-12 * (1 + along.squaredNorm()));
    EXPECT_LE(-power, torus.greatest_damping() * along.squaredNorm());
  }
}

/// To first order in the tilt α the branch leaves the circle w = π in proportion to α: where it passes u = 2.5, the
/// splitting doubles with the tilt.
TEST(Statement_5_8_6, SplittingIsOfFirstOrderInTheTilt) {
  const auto splitting = [](double tilt) {
    const Torus torus{{3, 1}, 1, 1, tilt};
    const auto found = critical_points(torus);
    const ChartField field(torus);
    const auto& saddle = found.points[2];
    const double z = (-1 + std::sqrt(1 - 4 * saddle.hessian_eigenvalues[0])) / 2;
    TorusState state{0, saddle.q + 1e-6 * Vector2d(0, 1), 1e-6 * z * Vector2d(0, 1)};
    mechanics::DormandPrince8Workspace<ChartField<Torus>> w(field, 1e-13);
    while (state.q[1] < 2.5 && state.t < 100) {
      const auto status = mechanics::DormandPrince8::step(field, 100, state, w);
      if (!status) break;
    }
    double early = w.t_start, late = state.t;  // the passage by bisection of the dense output
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (early + late);
      EXPECT_TRUE(mechanics::DormandPrince8::interpolate(field, middle, state, w));
      (state.q[1] < 2.5 ? early : late) = middle;
    }
    return std::abs(std::remainder(state.q[0] - pi, 2 * pi));
  };
  EXPECT_LT(splitting(0), 1e-8);
  EXPECT_GT(splitting(1e-4), 1e-4);
  EXPECT_NEAR(splitting(2e-4) / splitting(1e-4), 2, 1e-2);
}

/// Example 5.8.9: with D(v) = −c(q)v on a compact Q, μ = max c and k = |min V|, backwards in time
/// E_m(t) + k ≤ (E_m(0) + k) e^{−2μt}, t < 0: motions do not escape in finite time.
TEST(Statement_5_8_9, EnergyIsBoundedBackwards) {
  Torus torus{{3, 1}, 1, 0.5, 0.2};
  torus.c_w = 0.3;
  torus.c_u = 0.1;
  const ChartField field(torus);
  const double k = std::abs(critical_points(torus).points[0].V), mu = 0.5 * (1 + 0.3 + 0.1);
  EXPECT_NEAR(torus.depth(), k, 1e-13);
  EXPECT_NEAR(torus.greatest_damping(), mu, 1e-15);
  double tightest = 0;
  for (const auto& [q, v, ignored] : random_jets({-pi, -pi}, {pi, pi}, 10)) {
    const TorusState start{0, q, v};
    const double E0 = field.energy(q, v) + k;
    for (const double t : {-0.5, -1.0, -2.0, -3.0}) {
      const TorusState past = integrate(field, start, t, 1e-12);
      const double E = field.energy(past.q, past.v) + k, bound = E0 * std::exp(-2 * mu * t);
      EXPECT_GT(E, E0);
      EXPECT_LE(E, bound);
      tightest = std::max(tightest, std::log(E / E0) / (-2 * mu * t));
    }
  }
  EXPECT_GT(tightest, 0.5);  // a bound with half the rate would fail: the statement is not empty
}

}  // namespace
}  // namespace pseudorigid::testing
