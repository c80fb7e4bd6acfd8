/// The Jacobi metric: Oliva, Geometric Mechanics, 5.2.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mechanics/core/dense_algebra.h"
#include "mechanics/core/jacobi_metric.h"
#include "mechanics/methods/dormand_prince_8.h"
#include "support/integrate.h"
#include "support/pendulum_chain.h"
#include "support/surface_curves.h"
#include "systems/double_pendulum_chart.h"
#include "systems/torus.h"

namespace pseudorigid::testing {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using mechanics::ChartField;
using mechanics::JacobiGeodesicField;
using mechanics::JacobiLengthField;
using mechanics::JacobiMetric;
using mechanics::State;

using std::numbers::pi;

/// The Euclidean plane.
struct Plane {
  static constexpr int dimension = 2;
  template <class T>
  Eigen::Matrix<T, 2, 2> metric(const mechanics::Coordinates<T, 2>&) const {
    Eigen::Matrix<T, 2, 2> g;
    g << T(1.0), T(0.0), T(0.0), T(1.0);
    return g;
  }
};
/// U = ½|q|²
struct Oscillator : Plane {
  template <class T>
  T potential(const mechanics::Coordinates<T, 2>& q) const {
    return 0.5 * (q[0] * q[0] + q[1] * q[1]);
  }
};
/// U = −k/|q|
struct Kepler : Plane {
  double k = 1.3;
  template <class T>
  T potential(const mechanics::Coordinates<T, 2>& q) const {
    using std::sqrt;
    return -k / sqrt(q[0] * q[0] + q[1] * q[1]);
  }
};

struct Orbit {
  Vector2d q, v;
};
// With angular momentum: the metric degenerates where h = U.
constexpr double tolerance = 1e-14;  // local; the lengths below are wanted to 1e-10
const Orbit ellipse_about_centre{{1.1, 0.2}, {-0.3, 0.8}}, ellipse_about_focus{{1, 0.1}, {0.2, 1.3}};

/// Both ways: s̃ along the motion over its period, and the geodesic of that length, which must close at that time.
template <class C>
void expect_closed_geodesic(const C& chart, const Orbit& orbit, double period, double length) {
  const double h = mechanics::mechanical_energy(chart, orbit.q, orbit.v);

  const JacobiLengthField<C> motion(chart);
  State<JacobiLengthField<C>> start;
  motion.start(orbit.q, orbit.v, start.q, start.v);
  const auto end = integrate(motion, start, period, tolerance);
  EXPECT_LT((end.q.template head<2>() - orbit.q).norm(), 1e-10);
  EXPECT_NEAR(end.q[2], length, 1e-10);

  const JacobiGeodesicField<C> geodesics(chart, h);
  State<JacobiGeodesicField<C>> geodesic;
  ASSERT_TRUE(geodesics.start(orbit.q, orbit.v, geodesic.q, geodesic.v));
  const auto closed = integrate(geodesics, geodesic, length, tolerance);
  EXPECT_LT((closed.q.template head<2>() - orbit.q).norm(), 1e-10);
  EXPECT_NEAR(closed.q[2], period, 1e-10);
}

/// Proposition 5.2.1: Jacobi length of a closed orbit = ∮2K dt; harmonic oscillator: 2πh.
TEST(Statement_5_2_1, JacobiLengthOfTheHarmonicOscillator) {
  const auto& [q, v] = ellipse_about_centre;
  const double h = 0.5 * (q.squaredNorm() + v.squaredNorm());
  expect_closed_geodesic(Oscillator{}, ellipse_about_centre, 2 * pi, 2 * pi * h);
}

/// Kepler: 2|h|T with T = 2πk(2|h|)^{−3/2}.
TEST(Statement_5_2_1, JacobiLengthOfTheKeplerEllipse) {
  const Kepler kepler;
  const double h = mechanics::mechanical_energy(kepler, ellipse_about_focus.q, ellipse_about_focus.v);
  ASSERT_LT(h, 0);
  const double T = 2 * pi * kepler.k * std::pow(2 * std::abs(h), -1.5);
  expect_closed_geodesic(kepler, ellipse_about_focus, T, 2 * std::abs(h) * T);
}

/// Proposition 5.2.1: motions of energy h are geodesics of g_h with ds̃ = 2(h − U)dt: a motion of the double pendulum
/// and of the torus, at the same times.
TEST(Statement_5_2_1, MotionsAreGeodesicsOfTheJacobiMetric) {
  const auto compare = [](const auto& chart, const Vector2d& q, const Vector2d& v) {
    using C = std::decay_t<decltype(chart)>;
    const double h = mechanics::mechanical_energy(chart, q, v);
    const JacobiGeodesicField<C> geodesics(chart, h);
    State<JacobiGeodesicField<C>> start;
    ASSERT_TRUE(geodesics.start(q, v, start.q, start.v));
    for (const auto& geodesic : integrate_samples(geodesics, start, 20, 5, tolerance)) {
      const Vector2d x = geodesic.q.template head<2>(), dx = geodesic.v.template head<2>();
      const double factor = 2 * (h - mechanics::potential_energy(chart, x)), t = geodesic.q[2];
      EXPECT_NEAR(factor * dx.dot(chart.metric(x) * dx), 1, 1e-11);  // unit speed in g_h
      EXPECT_NEAR(geodesic.v[2] * factor, 1, 1e-11);                 // dt/ds̃ = 1/(2(h − U))
      const auto motion = integrate(ChartField<C>(chart), State<ChartField<C>>{0, q, v}, t, tolerance);
      EXPECT_LT((motion.q - x).norm() + (motion.v - factor * dx).norm(), 1e-10);
    }
  };
  compare(systems::DoublePendulumChart{1.3, 0.7, 0.9, 1.2, 1}, {0.4, -0.3}, {2.1, 1.4});  // U < h everywhere on the way
  compare(Kepler{}, {1, 0.1}, {0.2, 1.3});
}

/// Proposition 5.2.2: ∇̃_X Y = ∇_X Y + dρ(X)Y + dρ(Y)X − ⟨X, Y⟩ grad ρ, against the Christoffel symbols of e^{2ρ}g, in
/// two, three and five dimensions.
TEST(Statement_5_2_2, ConformalConnection) {
  const auto compare = [](const auto& chart, double h) {
    using C = std::decay_t<decltype(chart)>;
    constexpr int n = C::dimension;
    using Vector = mechanics::ChartVector<C>;
    const JacobiMetric<C> conformal{chart, h};
    Vector low = Vector::Constant(-2), high = Vector::Constant(2);
    low[0] = 0.3;
    for (const auto& jet : random_jets_in<n>(low, high, 50)) {
      const auto& [q, X, Y] = jet;
      std::array<mechanics::ChartMatrix<C>, n> Gamma, Gamma_conformal;
      ASSERT_TRUE(mechanics::christoffel_symbols(chart, q, Gamma));
      ASSERT_TRUE(mechanics::christoffel_symbols(conformal, q, Gamma_conformal));
      const Vector drho = -mechanics::potential_differential(chart, q) / (2 * (h - chart.potential(q)));  // (5.14)
      const Vector grad_rho = mechanics::solve(chart.metric(q), drho);
      const Vector rest = drho.dot(X) * Y + drho.dot(Y) * X - X.dot(chart.metric(q) * Y) * grad_rho;
      for (int k = 0; k < n; ++k) {
        const double exact = X.dot(Gamma[k] * Y) + rest[k];
        EXPECT_NEAR(X.dot(Gamma_conformal[k] * Y), exact, 1e-13 * (1 + Gamma[k].norm() + rest.norm()));
      }
    }
  };
  compare(systems::DoublePendulumChart{1.3, 0.7, 0.9, 1.2, 2.1}, 9);
  compare(systems::Torus{{3, 1}, 1, 1, 0.2}, 5);
  compare(Oscillator{}, 7);
  compare(PendulumChain<3>{}, 9);
  compare(PendulumChain<5>{}, 25);
}

/// The geodesic field by (5.12) is that of the metric g_h by its own Christoffel symbols.
TEST(Jacobi, GeodesicFieldIsThatOfTheConformalMetric) {
  const systems::DoublePendulumChart chart{1.3, 0.7, 0.9, 1.2, 2.1};
  constexpr double h = 9;
  const JacobiGeodesicField<systems::DoublePendulumChart> field(chart, h);
  const ChartField conformal(JacobiMetric<systems::DoublePendulumChart>{chart, h});
  auto w = field.make_workspace();
  auto w_conformal = conformal.make_workspace();
  for (const auto& [q, v, ignored] : random_jets({-3, -3}, {3, 3}, 50)) {
    Vector3d a = field.make_vector();
    Vector2d a_conformal;
    const Vector3d x(q[0], q[1], 0), dx(v[0], v[1], 0);
    ASSERT_TRUE(field.acceleration(0, x, dx, w, a));
    ASSERT_TRUE(conformal.acceleration(0, q, v, w_conformal, a_conformal));
    EXPECT_LT((a.head<2>() - a_conformal).norm(), 1e-13 * (1 + a_conformal.norm()));
  }
}

/// Where h ≤ U there is no Jacobi metric, and a geodesic that starts or comes there is refused.
TEST(Jacobi, RefusesPlacesOutOfReach) {
  const Oscillator chart;
  const JacobiGeodesicField<Oscillator> field(chart, 0.5);
  auto w = field.make_workspace();
  Vector3d x, dx, a;
  for (const double q : {1.0, 1.5}) {
    const auto status = field.start({q, 0}, {0, 0}, x, dx);
    EXPECT_NE(status.reason().find("only where U < h"), std::string::npos) << status.reason();
    EXPECT_FALSE(field.acceleration(0, {q, 0, 0}, {0.1, 0, 0}, w, a));
  }
  EXPECT_TRUE(field.acceleration(0, {0.9, 0, 0}, {0.1, 0, 0}, w, a));

  // Without angular momentum the geodesic runs into the boundary U = h at length ∫₀¹(1 − x²)^{1/2}dx = π/4.
  ASSERT_TRUE(field.start({0, 0}, {1, 0}, x, dx));
  State<JacobiGeodesicField<Oscillator>> state{0, x, dx};
  mechanics::DormandPrince8Workspace<JacobiGeodesicField<Oscillator>> workspace(field, 1e-12);
  mechanics::Status status;
  while (status && state.t < 1) status = mechanics::DormandPrince8::step(field, 1, state, workspace);
  EXPECT_FALSE(status);
  EXPECT_NEAR(state.t, pi / 4, 1e-3);
}

}  // namespace
}  // namespace pseudorigid::testing
