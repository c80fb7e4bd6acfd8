/// The heavy particle on the rough torus (Oliva, Geometric Mechanics, 5.8.8): its equations and its critical points.

#include "systems/torus.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "mechanics/equilibria/chart_landscape.h"
#include "mechanics/equilibria/critical_points.h"
#include "support/integrate.h"
#include "support/surface_curves.h"

namespace pseudorigid::testing {
namespace {

using Eigen::Vector2d;
using mechanics::ChartField;
using mechanics::ChartLandscape;
using systems::Torus;

using std::numbers::pi;
using TorusState = mechanics::State<ChartField<Torus>>;

/// 5.8.8: ẅ = −(3 + cos w) sin w u̇² + g sin w cos u − c ẇ;
///        d/dt[(3 + cos w)² u̇] = g (3 + cos w) sin u − c (3 + cos w)² u̇.
TEST(Statement_5_8_8, ChartFormIsTheTorusEquation) {
  const double g = 1.3, c = 0.4;
  const ChartField field(Torus{{3, 1}, g, c, 0});
  auto work = field.make_workspace();
  for (const auto& [q, v, ignored] : random_jets({-pi, -pi}, {pi, pi}, 50)) {
    Vector2d a;
    ASSERT_TRUE(field.acceleration(0, q, v, work, a));
    const double w = q[0], u = q[1], rho = 3 + std::cos(w);
    EXPECT_NEAR(a[0], -rho * std::sin(w) * v[1] * v[1] + g * std::sin(w) * std::cos(u) - c * v[0], 1e-13);
    const double momentum_rate = rho * rho * a[1] - 2 * rho * std::sin(w) * v[0] * v[1];
    EXPECT_NEAR(momentum_rate, g * rho * std::sin(u) - c * rho * rho * v[1], 1e-13);
  }
}

/// 5.8.8: four critical points of heights 4, 2, −2, −4 with Morse indices 2, 1, 1, 0.
TEST(Statement_5_8_8, CriticalHeightsAndIndices) {
  mechanics::CriticalPoints found;
  ASSERT_TRUE(mechanics::find_critical_points(ChartLandscape(Torus{}), {}, found));
  EXPECT_EQ(found.n_converged, found.n_starts);
  ASSERT_EQ(found.points.size(), 4u);
  constexpr std::array<double, 4> heights{-4, -2, 2, 4};
  constexpr std::array<int, 4> indices{0, 1, 1, 2};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto& p = found.points[k];
    EXPECT_NEAR(p.V, heights[k], 1e-13);
    EXPECT_EQ(p.morse_index, indices[k]);
    EXPECT_EQ(p.nullity, 0);
    EXPECT_TRUE(p.obeys_5_8_3());
  }
}

/// H in the metric at the lower saddle (w, u) = (π, π): V = −g(3 + cos w) there has V_ww = −g; V_uu = 2g, over ρ² = 4.
TEST(Torus, SpectrumAtTheLowerSaddle) {
  const double g = 1.3, c = 0.8;
  mechanics::CriticalPoints found;
  ASSERT_TRUE(mechanics::find_critical_points(ChartLandscape(Torus{{3, 1}, g, c, 0}), {}, found));
  ASSERT_EQ(found.points.size(), 4u);
  const auto& saddle = found.points[1];
  EXPECT_LT((saddle.q - Vector2d(pi, pi)).norm(), 1e-12);
  EXPECT_LT((saddle.hessian_eigenvalues - Vector2d(-g, g / 2)).norm(), 1e-13);
  for (const auto& z : saddle.rates)
    EXPECT_LT(std::min(std::abs(z * z + c * z - g), std::abs(z * z + c * z + g / 2)), 1e-12);
}

/// Tilted, the critical points are where the normal is vertical: on the circles u = 0, π at w = ±α (+ π).
TEST(Torus, TiltedCriticalPoints) {
  const double tilt = 0.3;
  mechanics::CriticalPoints found;
  ASSERT_TRUE(mechanics::find_critical_points(ChartLandscape(Torus{{3, 1}, 1, 1, tilt}), {}, found));
  ASSERT_EQ(found.points.size(), 4u);
  const std::array<Vector2d, 4> places{Vector2d(-tilt, pi), {pi - tilt, pi}, {tilt - pi, 0}, {tilt, 0}};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_LT((found.points[k].q - places[k]).norm(), 1e-12);
    EXPECT_EQ(found.points[k].morse_index, k == 0 ? 0 : k == 3 ? 2 : 1);
    EXPECT_TRUE(found.points[k].obeys_5_8_3());
  }
}

/// The angle from another symmetric circle is the same torus: place, energy and acceleration at w = w₀ + q₀.
TEST(Torus, AnglesFromTheInnerCircleAreTheSameTorus) {
  for (const double w : {3.0, -3.5, 0.2, 9.3, -6.4}) {
    const systems::TorusCircle circle(w);
    EXPECT_LE(std::abs(w - circle.angle()), pi / 2);
    EXPECT_NEAR(circle.outward(), std::cos(circle.angle()), 1e-14);
    const Torus from_outside{{3, 1}, 1.3, 0.4, 0.2}, from_circle{{3, 1, circle.outward()}, 1.3, 0.4, 0.2};
    const Vector2d q(w, 0.7), shifted(w - circle.angle(), 0.7), v(0.4, -0.6);
    EXPECT_LT((from_outside.embedding(q) - from_circle.embedding(shifted)).norm(), 1e-14);
    const ChartField field(from_outside), same(from_circle);
    EXPECT_NEAR(field.energy(q, v), same.energy(shifted, v), 1e-13);
    auto work = field.make_workspace();
    auto other = same.make_workspace();
    Vector2d a, b;
    ASSERT_TRUE(field.acceleration(0, q, v, work, a));
    ASSERT_TRUE(same.acceleration(0, shifted, v, other, b));
    EXPECT_LT((a - b).norm(), 1e-13);
  }
}

/// On the inner circle nothing pushes across, not even round-off.
TEST(Torus, InnerCircleIsInvariantExactly) {
  const ChartField field(Torus{{3, 1, -1}, 1.3, 0.4, 0});
  auto work = field.make_workspace();
  for (const auto& [q, v, ignored] : random_jets({-pi, -pi}, {pi, pi}, 20)) {
    Vector2d a;
    ASSERT_TRUE(field.acceleration(0, {0, q[1]}, {0, v[1]}, work, a));
    EXPECT_EQ(a[0], 0);
  }
}

/// Motions come to rest at the lowest point.
TEST(Torus, MotionsEndInTheSink) {
  const ChartField field(Torus{});
  for (const auto& [q, v, ignored] : random_jets({-pi, -pi}, {pi, pi}, 10)) {
    const TorusState end = integrate(field, TorusState{0, q, v}, 80, 1e-10);
    EXPECT_NEAR(std::remainder(end.q[0], 2 * pi), 0, 1e-8);
    EXPECT_NEAR(std::abs(std::remainder(end.q[1], 2 * pi)), pi, 1e-8);
    EXPECT_LT(end.v.norm(), 1e-8);
  }
}

}  // namespace
}  // namespace pseudorigid::testing
