#include "mechanics/core/orbit.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numbers>

#include "mechanics/core/kepler_motion.h"

namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using pseudorigid::mechanics::Companions, pseudorigid::mechanics::Orbit;

constexpr double G = 0.7, M = 4.2;

Companions planet_and_sun() {
  return {{.mass = 30, .position = Vector3d(7, 1, -2), .velocity = Vector3d(0.3, 1.2, 0.4)},
          {.mass = 500, .position = Vector3d(-40, 60, 5), .velocity = Vector3d(-2, 0.5, 0.1)}};
}

Matrix3d moment() { return (Matrix3d() << 1.1, 0.1, -0.2, 0.1, 0.9, 0.05, -0.2, 0.05, 0.7).finished(); }

TEST(Orbit, StartsWithTheGivenMotion) {
  const Companions list = planet_and_sun();
  const Orbit orbit(list, G, M);
  for (int i = 0; i < 2; ++i) {
    EXPECT_LT((orbit.relative(orbit.position()).col(i) - list[i].position).norm(), 1e-13);
    EXPECT_LT((orbit.relative(orbit.velocity()).col(i) - *list[i].velocity).norm(), 1e-13);
  }
}

/// In the frame of the common centre of mass, with the position −Σ m_i r_i/Σm of the body.
TEST(Orbit, HasTheKineticEnergyAndMomentumOfPointMasses) {
  const Companions list = planet_and_sun();
  const Orbit orbit(list, G, M);
  const double whole = M + list[0].mass + list[1].mass;
  Vector3d center = Vector3d::Zero(), drift = Vector3d::Zero();
  for (const auto& one : list) {
    center += one.mass / whole * one.position;
    drift += one.mass / whole * *one.velocity;
  }
  double kinetic = 0.5 * M * drift.squaredNorm();
  Vector3d J = M * center.cross(drift);
  for (const auto& one : list) {
    const Vector3d r = one.position - center, v = *one.velocity - drift;
    kinetic += 0.5 * one.mass * v.squaredNorm();
    J += one.mass * r.cross(v);
  }
  EXPECT_NEAR(0.5 * orbit.velocity().squaredNorm(), kinetic, 1e-12 * kinetic);
  EXPECT_LT((Orbit::momentum(orbit.position(), orbit.velocity()) - J).norm(), 1e-12 * J.norm());
}

TEST(Orbit, ForceIsTheGradientOfTheEnergy) {
  const Orbit orbit(planet_and_sun(), G, M);
  const Orbit::Columns s = orbit.position(), f = orbit.force(moment(), s);
  constexpr double h = 1e-3;
  for (Eigen::Index i = 0; i < s.size(); ++i) {
    const auto at = [&](double distance) {
      Orbit::Columns moved = s;
      moved(i) += distance;
      return orbit.energy(moment(), moved);
    };
    const double rate = (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
    EXPECT_NEAR(f(i), -rate, 1e-9 * f.norm()) << i;
  }
}

/// dU = ½ T:dS, and the torque on the body is opposite to the moment of the forces on the companions.
TEST(Orbit, TideIsTheDerivativeByTheSecondMoment) {
  const Orbit orbit(planet_and_sun(), G, M);
  const Orbit::Columns& s = orbit.position();
  const Matrix3d T = orbit.tide(s), dS = Matrix3d::Random() + Matrix3d::Random().transpose();
  const Matrix3d symmetric = 0.5 * (dS + dS.transpose());
  const double change = orbit.energy(moment() + symmetric, s) - orbit.energy(moment(), s);
  EXPECT_NEAR(change, 0.5 * T.cwiseProduct(symmetric).sum(), 1e-12 * std::abs(orbit.energy(moment(), s)));
  EXPECT_NEAR(T.trace(), 0, 1e-15);
  const Orbit::Columns f = orbit.force(moment(), s);
  EXPECT_LT((orbit.torque(moment(), s) + Orbit::momentum(s, f)).norm(), 1e-13 * f.norm() * s.norm());
}

TEST(Orbit, CircularWithoutVelocities) {
  const Orbit orbit(Companions{{.mass = 3, .position = Vector3d(0, 5, 0)}}, G, M);
  const Vector3d v = orbit.relative(orbit.velocity()).col(0);
  EXPECT_LT((v - Vector3d(-std::sqrt(G * (M + 3) / 5), 0, 0)).norm(), 1e-15);
}

TEST(Orbit, KnowsTheLeastDistanceOnALine) {
  const Orbit orbit(Companions{{.mass = 3, .position = Vector3d(4, 0.5, 0)}}, G, M);
  Orbit::Columns past = orbit.position();
  EXPECT_NEAR(orbit.least_distance(past, past), std::hypot(4, 0.5), 1e-14);
  past(0) *= -1;
  EXPECT_NEAR(orbit.least_distance(orbit.position(), past), 0.5, 1e-14);
  const Orbit two(Companions{{.mass = 3, .position = Vector3d(9, 0, 0)}, {.mass = 1, .position = Vector3d(9, 0.2, 0)}},
                  G, M);
  EXPECT_NEAR(two.least_distance(two.position(), two.position()), 0.2, 1e-13);
  const Matrix3d S = M / 5 * Vector3d(1.2, 0.9, 1).cwiseAbs2().asDiagonal();
  EXPECT_NEAR(orbit.largest_semi_axis(S), 1.2, 1e-14);
}

/// An orbit of eccentricity e from its apocentre; the pericentre is a half period later.
TEST(Orbit, FindsThePericentre) {
  const double mass = 3, e = 0.9, a = 10, g = G * (M + mass), n = std::sqrt(g / (a * a * a)),
               half = std::numbers::pi / n;
  const double speed = std::sqrt(g / a * (1 - e) / (1 + e));
  const Orbit orbit(
      Companions{{.mass = mass, .position = Vector3d(a * (1 + e), 0, 0), .velocity = Vector3d(0, speed, 0)}}, G, M);
  const auto distance = [&](double end, double before) {
    return orbit.relative(orbit.near_closest_approach(end, before).s).norm();
  };
  EXPECT_NEAR(distance(3 * half, 0), a * (1 - e), 0.01 * a);
  EXPECT_GT(distance(3 * half, 0.1 * half), a * (1 - e) * 1.5);
  EXPECT_NEAR(distance(3 * half, 3 * half), a * (1 + e), 1e-12) << "the start";
  const Orbit circle(Companions{{.mass = mass, .position = Vector3d(5, 0, 0)}}, G, M);
  EXPECT_EQ(circle.near_closest_approach(100, 0).s, circle.position());
  // The first of many pericentres, also after 1e6 periods.
  EXPECT_EQ(orbit.near_closest_approach(2e6 * half, 0).s, orbit.near_closest_approach(2 * half, 0).s);
}

/// With the half steps of the whole force, the drift is Kepler's motion if the body is a sphere and has one companion.
TEST(Orbit, DriftBetweenTwoHalfStepsIsKeplersMotion) {
  const Orbit orbit({planet_and_sun()[0]}, G, M);
  const Matrix3d sphere = 0.3 * M * Matrix3d::Identity();
  const Orbit::Columns start = orbit.position();
  for (const double h : {0.01, 3.0, -20.0}) {
    Orbit::Columns s = start, sdot = orbit.velocity() + h / 2 * orbit.force(sphere, start);
    orbit.drift(h, s, sdot);
    sdot += h / 2 * orbit.force(sphere, s);
    const double m = planet_and_sun()[0].mass, whole = M + m, mu = m * M / whole;
    const auto exact = pseudorigid::mechanics::kepler_increments(G * whole, start / std::sqrt(mu),
                                                                 orbit.velocity() / std::sqrt(mu), h);
    EXPECT_LT((s - start - std::sqrt(mu) * exact.s).norm(), 1e-12 * s.norm()) << h;
    EXPECT_LT((sdot - orbit.velocity() - std::sqrt(mu) * exact.sdot).norm(), 1e-12 * sdot.norm()) << h;
  }
}

}  // namespace
