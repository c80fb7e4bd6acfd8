#include "mechanics/core/kepler.h"

#include <gtest/gtest.h>

#include "mechanics/core/orbit.h"

namespace {

using Eigen::Vector3d;
using namespace pseudorigid::mechanics;

constexpr double pi = std::numbers::pi, g = 1.7;

void expect_equal(const KeplerElements& a, const KeplerElements& b, double bound) {
  EXPECT_NEAR(a.semi_major_axis, b.semi_major_axis, bound * std::abs(b.semi_major_axis));
  EXPECT_NEAR(a.eccentricity, b.eccentricity, bound);
  EXPECT_NEAR(a.inclination, b.inclination, bound);
  EXPECT_NEAR(a.ascending_node, b.ascending_node, bound);
  EXPECT_NEAR(a.argument_of_pericentre, b.argument_of_pericentre, bound);
  EXPECT_NEAR(a.mean_anomaly, b.mean_anomaly, bound * (1 + std::abs(b.mean_anomaly)));
}

TEST(Kepler, EquationIsSolvedToRoundOff) {
  for (const double e : {0.0, 1e-8, 0.1, 0.5, 0.9, 0.99, 0.9999, 1 - 1e-9})
    for (double mean = -7; mean <= 7; mean += 0.0137) {
      const double E = eccentric_anomaly(mean, e);
      EXPECT_NEAR(E - e * std::sin(E), mean, 4e-15 * (1 + std::abs(mean))) << e << " " << mean;
    }
  for (const double e : {1 + 1e-9, 1.01, 1.5, 7.0, 1e6})
    for (const double mean : {0.0, 1e-9, 0.01, -0.3, 2.0, -40.0, 1e8}) {
      const double H = hyperbolic_anomaly(mean, e);
      EXPECT_NEAR(e * std::sinh(H) - H, mean, 1e-14 * (1 + std::abs(mean) + e * std::abs(H))) << e << " " << mean;
    }
}

TEST(Kepler, ElementsAndMotionAreInverse) {
  for (const double e : {0.01, 0.3, 0.9, 0.99})
    for (const double mean : {-3.0, -0.2, 0.0, 1.0, 3.1})
      for (const double angle : {-2.5, 0.4, 3.0}) {
        const KeplerElements o{5, e, std::abs(angle), -angle / 2, angle, mean};
        const OrbitalMotion m = motion_of(o, g);
        expect_equal(elements_of(m.position, m.velocity, g), o, 1e-12 / ((1 - e) * e));
      }
  for (const double e : {1.1, 2.0, 30.0})
    for (const double mean : {-300.0, -0.2, 0.0, 12.0}) {
      const KeplerElements o{-5, e, 0.7, -2, 1.2, mean};
      const OrbitalMotion m = motion_of(o, g);
      expect_equal(elements_of(m.position, m.velocity, g), o, 1e-12 / (e - 1));
    }
}

/// The vis-viva equation, the area law h² = g a (1 − e²), and a retrograde orbit in the plane.
TEST(Kepler, MotionHasTheEnergyAndTheAreaLaw) {
  for (const auto& [a, e] : {std::pair(4.0, 0.6), std::pair(-4.0, 1.6)}) {
    const OrbitalMotion m = motion_of({a, e, 1, 0.5, 2, 0.8}, g);
    EXPECT_NEAR(m.velocity.squaredNorm(), g * (2 / m.position.norm() - 1 / a), 1e-14 * g);
    const Vector3d h = m.position.cross(m.velocity);
    EXPECT_NEAR(h.squaredNorm(), g * a * (1 - e * e), 1e-13 * g);
    EXPECT_NEAR(std::acos(h[2] / h.norm()), 1, 1e-14);
  }
  const OrbitalMotion back = motion_of({2, 0.5, pi, 0, 0, 0}, g);
  EXPECT_LT((back.position - Vector3d(1, 0, 0)).norm(), 1e-15);
  EXPECT_LT(back.velocity[1], 0);
}

TEST(Kepler, CircleParabolaAndFreeFallAreFinite) {
  const KeplerElements circle = elements_of(Vector3d(0, 2, 0), Vector3d(-std::sqrt(g / 2), 0, 0), g);
  EXPECT_NEAR(circle.eccentricity, 0, 1e-15);
  EXPECT_EQ(circle.ascending_node, 0);
  EXPECT_NEAR(std::remainder(circle.argument_of_pericentre + circle.mean_anomaly - pi / 2, 2 * pi), 0, 1e-14);
  const KeplerElements parabola = elements_of(Vector3d(2, 0, 0), Vector3d(0, 1, 0), 1);
  EXPECT_EQ(parabola.semi_major_axis, 0);
  for (const Vector3d& v : {Vector3d(0, 0, 0), Vector3d(-1, 0, 0), Vector3d(9, 0, 0)}) {
    const KeplerElements o = elements_of(Vector3d(2, 0, 0), v, g);
    EXPECT_TRUE(std::isfinite(o.mean_anomaly + o.argument_of_pericentre + o.inclination + o.ascending_node));
    EXPECT_NEAR(o.eccentricity, 1, 1e-15);
  }
}

/// The elements of a second companion are those about the centre of mass of the body and the first, with all masses.
TEST(Kepler, SecondCompanionMovesAboutTheCentreOfTheOthers) {
  constexpr double G = 0.7, M = 4, m = 30, sun = 500;
  const KeplerElements inner{7, 0.2, 0.1, 1, 2, 3}, outer{90, 0.4, 0.3, -1, 0.5, -2};
  const Orbit orbit(Companions{{.mass = m, .elements = inner}, {.mass = sun, .elements = outer}}, G, M);
  const Orbit::Columns r = orbit.relative(orbit.position()), v = orbit.relative(orbit.velocity());
  expect_equal(elements_of(r.col(0), v.col(0), G * (M + m)), inner, 1e-13);
  const double part = m / (M + m);
  expect_equal(elements_of(r.col(1) - part * r.col(0), v.col(1) - part * v.col(0), G * (M + m + sun)), outer, 1e-13);
}

}  // namespace
