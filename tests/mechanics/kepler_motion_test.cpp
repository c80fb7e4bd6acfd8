#include "mechanics/core/kepler_motion.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <random>

namespace pseudorigid::mechanics {
namespace {

using Eigen::Vector3d;

double energy(double k, const Vector3d& s, const Vector3d& v) { return v.squaredNorm() / 2 - k / s.norm(); }

TEST(KeplerMotion, CircleTurnsUniformly) {
  const double k = 2.5, r = 3, n = std::sqrt(k / (r * r * r));
  const Vector3d s(r, 0, 0), v(0, r * n, 0);
  for (const double t : {-7.0, 0.01, 1.0, 40.0, 3000.0}) {
    const KeplerIncrements d = kepler_increments(k, s, v, t);
    const double round_off = 1e-15 * (1 + std::abs(n * t));
    EXPECT_LT((s + d.s - r * Vector3d(std::cos(n * t), std::sin(n * t), 0)).norm(), 20 * r * round_off) << t;
  }
}

TEST(KeplerMotion, EllipseReturnsAfterAPeriod) {
  const double k = 1, a = 2, e = 0.99, period = 2 * std::numbers::pi * std::sqrt(a * a * a / k);
  const Vector3d s(a * (1 - e), 0, 0), v(0, std::sqrt(k / a * (1 + e) / (1 - e)), 0);
  const KeplerIncrements half = kepler_increments(k, s, v, period / 2), whole = kepler_increments(k, s, v, period);
  EXPECT_LT((s + half.s - Vector3d(-a * (1 + e), 0, 0)).norm(), 1e-11);
  EXPECT_LT(whole.s.norm(), 1e-11);
}

/// Orbits of all kinds with a pericentre of at least a twentieth of the distance, forwards and backwards.
TEST(KeplerMotion, KeepsTheConstantsOfRandomOrbitsAndReturns) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  int n_orbits = 0;
  while (n_orbits < 20'000) {
    const double k = std::pow(10, 2 * u(random));
    const Vector3d s = std::pow(10, 2 * u(random)) * Vector3d(u(random), u(random), u(random));
    const Vector3d v =
        std::sqrt(k / s.norm()) * std::pow(10, 0.7 * u(random)) * Vector3d(u(random), u(random), u(random));
    const double e = (v.cross(s.cross(v)) / k - s.normalized()).norm();
    if (s.cross(v).squaredNorm() / k / (1 + e) < 0.05 * s.norm()) continue;
    ++n_orbits;
    const double h =
        std::sqrt(std::pow(s.norm(), 3) / k) * std::pow(10, -3 + 1.75 * (u(random) + 1)) * (u(random) > 0 ? 1 : -1);
    const KeplerIncrements d = kepler_increments(k, s, v, h);
    const Vector3d s1 = s + d.s, v1 = v + d.sdot;
    const double size = k / s.norm() + v.squaredNorm() + k / s1.norm() + v1.squaredNorm();
    ASSERT_NEAR(energy(k, s1, v1), energy(k, s, v), 1e-12 * size) << n_orbits;
    ASSERT_LT((s1.cross(v1) - s.cross(v)).norm(), 1e-12 * (s.norm() * v.norm() + s1.norm() * v1.norm())) << n_orbits;
    const KeplerIncrements back = kepler_increments(k, s1, v1, -h);
    ASSERT_LT((d.s + back.s).norm(), 1e-11 * (s.norm() + s1.norm())) << n_orbits;
  }
}

TEST(KeplerMotion, SmallTimesHaveTheSeriesOfTheMotion) {
  const double k = 1.7, h = 1e-3;
  const Vector3d s(1, 0.4, -0.2), v(-0.3, 0.9, 0.1);
  const KeplerIncrements d = kepler_increments(k, s, v, h);
  const double r = s.norm();
  const Vector3d a = -k / (r * r * r) * s, jerk = -k / (r * r * r) * (v - 3 * s.dot(v) / (r * r) * s);
  EXPECT_LT((d.s - (h * v + h * h / 2 * a + h * h * h / 6 * jerk)).norm(), h * h * h * h);
}

}  // namespace
}  // namespace pseudorigid::mechanics
