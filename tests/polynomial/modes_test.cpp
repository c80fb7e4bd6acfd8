/// Frequencies of polynomial balls at rest against those of the exact sphere (PHYSICS section 3): every copy of a mode
/// is there, and errors fall exponentially with the degree.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "analysis/sphere_frequencies.h"
#include "polynomial/incompressible_body.h"
#include "polynomial/rest_modes.h"

namespace pseudorigid::testing {
namespace {

using polynomial::BodySetup;
using polynomial::RestFrequency;
using Kind = std::pair<bool, int>;  // spheroidal, degree

/// The fundamental of each kind and degree.
std::map<Kind, RestFrequency> fundamentals(const BodySetup& setup, bool incompressible) {
  std::vector<RestFrequency> found;
  const auto status = rest_frequencies(setup, incompressible, 1000, found);
  EXPECT_TRUE(status) << status.reason();
  std::map<Kind, RestFrequency> lowest;
  for (const RestFrequency& f : found)
    if (f.overtone == 0) lowest.emplace(Kind{f.spheroidal, f.degree}, f);
  return lowest;
}

double relative_error(const std::map<Kind, RestFrequency>& modes, bool spheroidal, int n, double exact) {
  const auto mode = modes.find({spheroidal, n});
  EXPECT_NE(mode, modes.end()) << (spheroidal ? "S" : "T") << n;
  return mode == modes.end() ? HUGE_VAL : std::abs(mode->second.omega / exact - 1);
}

/// √10 of the pseudo-rigid ball, and what a prototype gave for N = 3, 5 (PHYSICS section 10).
TEST(PolynomialModes, ErrorOfS2FallsAsMeasured) {
  constexpr double exact = 2.665622189236;
  const auto error = [&](int N) { return relative_error(fundamentals({.degree = N}, true), true, 2, exact); };
  EXPECT_NEAR(fundamentals({.degree = 1}, true).at({true, 2}).omega, std::sqrt(10.0), 1e-13);
  EXPECT_NEAR(error(3), 2.90e-3, 1e-5);
  EXPECT_NEAR(error(5), 6.41e-6, 1e-8);
  EXPECT_LT(error(7), 1e-8);
  EXPECT_LT(error(9), 1e-11);
}

/// From one degree to the second next the errors fall by a factor that rises: faster than any power of N.
TEST(PolynomialModes, ConvergeExponentially) {
  std::map<Kind, double> before, fall_before;
  for (const int N : {3, 5, 7, 9}) {
    const auto modes = fundamentals({.degree = N}, true);
    for (const bool spheroidal : {true, false})
      for (int n = 1; n <= 4; ++n) {
        const Kind kind{spheroidal, n};
        if (!modes.contains(kind)) continue;
        const double error = relative_error(modes, spheroidal, n, analysis::sphere_frequency(spheroidal, n, 0));
        if (before.contains(kind)) {
          const double fall = before[kind] / error;
          EXPECT_GT(fall, 3) << spheroidal << n << " N = " << N;
          if (fall_before.contains(kind)) {
            EXPECT_GT(fall, fall_before[kind]) << spheroidal << n << " N = " << N;
          }
          fall_before[kind] = fall;
        }
        before[kind] = error;
      }
  }
  for (const bool spheroidal : {true, false})
    for (int n = 1; n <= 4; ++n) EXPECT_LT((before[{spheroidal, n}]), 2e-5) << spheroidal << n;
}

/// Of all motions on ker G the three shifts and the three turns alone have no frequency, and every mode has its copies.
TEST(PolynomialModes, NoneIsMissing) {
  for (const int N : {1, 2, 3, 4, 5}) {
    const auto dimension = [](int degree) { return (degree + 1) * (degree + 2) * (degree + 3) / 6; };
    std::vector<RestFrequency> found;
    ASSERT_TRUE(rest_frequencies({.degree = N}, true, 10000, found));
    int n_modes = 0;
    for (const RestFrequency& f : found) {
      n_modes += 2 * f.degree + 1;
      EXPECT_LT((f.largest - f.least) / f.omega, 1e-12) << "N = " << N << ", omega = " << f.omega;
    }
    EXPECT_EQ(n_modes, 3 * dimension(N) - dimension(N - 1) - 6) << "N = " << N;
  }
}

/// The copies agree to round-off: the spaces are invariant under turns, and the quadrature does not see them.
TEST(PolynomialModes, CopiesAgree) {
  for (const auto& [kind, f] : fundamentals({.degree = 5}, true))
    EXPECT_LT((f.largest - f.least) / f.omega, 1e-12) << kind.first << kind.second;
}

TEST(PolynomialModes, CompressibleBallsHaveRadialOnes) {
  constexpr double mu = 1, lambda = 2;
  const double ratio = std::sqrt(mu / (lambda + 2 * mu));  // c/c_p
  double before = HUGE_VAL;
  for (const int N : {3, 5, 7}) {
    const auto modes = fundamentals({.degree = N, .law = materials::CiarletGeymonat{mu, lambda}}, false);
    const double error = relative_error(modes, true, 0, analysis::compressible_sphere_frequency(true, 0, 0, ratio));
    EXPECT_LT(error, before / 50) << "N = " << N;
    before = error;
    EXPECT_LT(relative_error(modes, true, 2, analysis::compressible_sphere_frequency(true, 2, 0, ratio)), 1e-2);
  }
  EXPECT_LT(before, 1e-8);
}

/// γ = 5 (PHYSICS section 3): the quadrature of gravity leaves 1e-7.
TEST(PolynomialModes, WithSelfGravity) {
  for (const double gamma : {1.0, 5.0}) {
    BodySetup setup{.degree = 7};
    setup.loads.get<loads::SelfGravity>().constant = gamma * 3 / (4 * std::numbers::pi);
    const auto modes = fundamentals(setup, true);
    EXPECT_LT(relative_error(modes, true, 2, analysis::sphere_frequency(true, 2, 0, gamma)), 2e-7);
    EXPECT_LT(relative_error(modes, false, 2, analysis::sphere_frequency(false, 2, 0)), 2e-7);
  }
}

/// Elasticity is a small part of the stiffness where γ is large; kinds and degrees stay apart all the same. T1 of
/// degree 9 is 3e-6 from the sphere's, S3 4e-4 at any γ.
TEST(PolynomialModes, WithStrongSelfGravity) {
  for (const double gamma : {4e3, 4e8}) {
    BodySetup setup{.degree = 9, .law = materials::CiarletGeymonat{1 / gamma, 0}};
    setup.loads.get<loads::SelfGravity>().constant = 3 / (4 * std::numbers::pi);
    const auto modes = fundamentals(setup, true);
    for (const bool spheroidal : {true, false})
      for (int n = 1; n <= 3; ++n) {
        const double exact = analysis::sphere_frequency(spheroidal, n, 0, gamma) / std::sqrt(gamma);
        EXPECT_LT(relative_error(modes, spheroidal, n, exact), 1e-3) << spheroidal << n << ", gamma = " << gamma;
      }
    for (const auto& [kind, f] : modes) {
      EXPECT_LT((f.largest - f.least) / f.omega, 1e-6) << kind.first << kind.second << ", gamma = " << gamma;
      EXPECT_GT(f.share, 1 - 1e-9) << kind.first << kind.second;
    }
  }
}

/// The exact second variation of gravity at rest is the limit of that of the motion's quadrature: with 24 points in a
/// direction ω² = u·Ku to 1e-6.
TEST(PolynomialModes, GravityIsThatOfTheMotion) {
  BodySetup setup{.degree = 4, .n_gravity_points = 24};
  setup.loads.get<loads::SelfGravity>().constant = 1;
  const polynomial::IncompressibleBody body(setup);
  const Eigen::VectorXd X = body.affine(Eigen::Matrix3d::Identity());
  int n_spheroidal = 0;
  for (const auto& [kind, f] : fundamentals(setup, true)) {
    if (!kind.first || kind.second > 3) continue;
    Eigen::VectorXd rate = body.make_vector();
    body.add_force_rate(X, f.shape, rate);
    EXPECT_NEAR(-rate.dot(f.shape) / (f.omega * f.omega), 1, 1e-6) << "S" << kind.second;
    ++n_spheroidal;
  }
  EXPECT_EQ(n_spheroidal, 3);
}

/// Of a negative modulus every motion grows, at the rates that are the frequencies of the positive one.
TEST(PolynomialModes, UnstableOnesAreFound) {
  const auto stable = fundamentals({.degree = 3}, true);
  const BodySetup unstable{.degree = 3, .law = materials::CiarletGeymonat{-1, 0}};
  std::vector<RestFrequency> found;
  ASSERT_TRUE(rest_frequencies(unstable, true, 1000, found));
  ASSERT_FALSE(found.empty());
  const double slowest = -found.back().omega;
  EXPECT_NEAR(slowest / stable.at({false, 2}).omega, 1, 1e-12);
  for (const RestFrequency& f : found) EXPECT_LT(f.largest, 0);
}

TEST(PolynomialModes, AStressedBallHasNoRest) {
  std::vector<RestFrequency> found;
  const BodySetup stressed{.degree = 3, .law = materials::SaintVenantKirchhoffAsPrinted{1, 1}};
  EXPECT_FALSE(rest_frequencies(stressed, false, 5, found));
  EXPECT_TRUE(rest_frequencies(stressed, true, 5, found)) << "incompressibility carries a pressure";
}

}  // namespace
}  // namespace pseudorigid::testing
