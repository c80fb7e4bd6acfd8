/// What Oliva, Geometric Mechanics, says after 5.6.15: the regular level sets of (K, p) of the free body are tori, on
/// which its motion is quasi-periodic. After a period of P the body has turned by one angle about p, from wherever on
/// the torus it starts; that angle is Montgomery's (Am. J. Phys. 59, 394, 1991),
///
///   α = 2KT/|p| − S   (mod 2π),   S the solid angle that the closed curve of P/|P| encloses in the body.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "support/integrate.h"
#include "systems/free_top.h"
#include "systems/rigid_motions.h"

namespace pseudorigid::testing {
namespace {

using FreeTopByEuler = systems::EulerTop<>;
using std::numbers::pi;

struct FreeBodyOfMoments {
  Vector3d moments;
  double K, L;  // 2KI₂ < L² < 2KI₃: P goes round the third axis
};
const std::vector<FreeBodyOfMoments> three_bodies{
    {{2, 3, 4}, 1.0, std::sqrt(6.8)}, {{1, 2, 2.5}, 0.7, std::sqrt(3.1)}, {{0.6, 0.7, 1.25}, 1.9, std::sqrt(3.0)}};

/// S of the curve in which the sphere |P| = L meets the ellipsoid ½⟨P, A⁻¹P⟩ = K, about the third axis: with the
/// azimuth φ, S = ∮(1 − cos θ)dφ, sin²θ = (2K/L² − 1/I₃)/(cos²φ/I₁ + sin²φ/I₂ − 1/I₃). The trapezoidal rule converges
/// like e^{−cn} on a period.
double solid_angle(const FreeBodyOfMoments& b) {
  constexpr int n = 512;
  double sum = 0;
  for (int k = 0; k < n; ++k) {
    const double c = std::cos(2 * pi * k / n), s = std::sin(2 * pi * k / n);
    const double sin2 =
        (2 * b.K / (b.L * b.L) - 1 / b.moments(2)) / (c * c / b.moments(0) + s * s / b.moments(1) - 1 / b.moments(2));
    sum += 1 - std::sqrt(1 - sin2);
  }
  return 2 * pi / n * sum;
}

/// The rotation that the program's motion makes in a time, from the point of the torus that is reached at t0.
Matrix3d turn(const FreeBodyOfMoments& b, double t0, double duration) {
  const auto start = FreeTop(b.moments, b.K, b.L).at(t0);
  const FreeTopByEuler top({b.moments.asDiagonal(), {}});
  const auto end = integrate(top, FreeTopByEuler::turning(start.R, start.Omega), duration, 1e-15);
  return FreeTopByEuler::rotation(end.q) * start.R.transpose();
}
/// About e_z.
Matrix3d about_p(double angle) { return Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix(); }

/// After each period of P the body has turned about p by Montgomery's angle, for three bodies and from several starts.
TEST(Statement_5_6_15, AfterAPeriodTheBodyHasTurnedByMontgomerysAngle) {
  for (const auto& b : three_bodies) {
    const double T = FreeTop(b.moments, b.K, b.L).period(), alpha = 2 * b.K * T / b.L - solid_angle(b);
    for (const double t0 : {0.0, 0.3 * T, 1.7 * T}) EXPECT_LT((turn(b, t0, T) - about_p(alpha)).norm(), 1e-9);
    EXPECT_LT((turn(b, 0, 5 * T) - about_p(5 * alpha)).norm(), 1e-9) << "quasi-periodic: R(kT) = R_p(kα)R(0)";
    EXPECT_GT((turn(b, 0, 0.9 * T) - about_p(alpha)).norm(), 0.01) << "T is the period";
    EXPECT_GT(std::abs(std::remainder(alpha, 2 * pi)), 0.01) << "not periodic";
  }
}

/// (K, p) is regular all along such a motion, so that the level set is a surface, and the motion returns to the places
/// of P but not of R: two independent frequencies.
TEST(Statement_5_6_15, EnergyAndMomentumAreIndependentOnTheTorus) {
  for (const auto& b : three_bodies) {
    const FreeTop exact(b.moments, b.K, b.L);
    const FixedPointBody body({systems::second_moment(b.moments.asDiagonal()), {}});
    for (int k = 0; k < 8; ++k) {
      // Not at whole quarters of the period, where Boost's elliptic functions lose all but two digits.
      const auto motion = exact.at(exact.period() * (k + 0.3) / 8);
      EXPECT_GT(smallest_singular_value(body, motion.Omega), 0.01);
      const auto s = systems::turning(motion.R, motion.Omega);
      EXPECT_NEAR(body.kinetic_energy(s.v), b.K, 1e-13);
      EXPECT_LT((body.angular_momentum(s.q, s.v) - Vector3d(0, 0, b.L)).norm(), 1e-13);
    }
  }
}

}  // namespace
}  // namespace pseudorigid::testing
