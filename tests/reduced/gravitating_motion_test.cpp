/// Motions and figures of the pseudo-rigid body with self-gravity, elastic and fluid (PHYSICS sections 3-6): small and
/// nonlinear oscillations, tides, spin.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mechanics/steps/largest_frequency.h"
#include "reduced/potentials.h"
#include "reduced/turning_point.h"

namespace pseudorigid::testing {
namespace {

constexpr double pi = std::numbers::pi;

template <class Body>
double frequency_at_rest(const Body& body) {
  typename Body::Workspace w;
  const auto report = mechanics::largest_frequency(body, stretched(1), w, 12);
  EXPECT_TRUE(report.status) << report.status.reason();
  return report.omega;
}

/// PHYSICS section 3, Kelvin: ω² = 16πGρ/15 of the fluid ball, and of a motion with small amplitude.
TEST(GravitatingOscillation, OfTheFluidBallIsKelvins) {
  for (const double G : {fluid_time_G, 0.05, 7.0})
    EXPECT_NEAR(std::pow(frequency_at_rest(fluid_sl3({G})), 2), 16 * pi * G / 15, 1e-8 * G);
  // the shift (1013/2352)A² is 2e-10; ℓ̇ of 1e-5 is known to 1e-11 of itself
  const double period = turning_point(fluid_sl3({fluid_time_G}), std::exp(2e-5), 2).t;
  EXPECT_NEAR(2 * pi / period, std::sqrt(16.0 / 15), 1e-9);
}

/// PHYSICS section 3: x² = 10 + 0.8γ, γ = ρga/μ, g = (4/3)πGρa.
TEST(GravitatingOscillation, OfTheElasticBallIsStiffenedByGravity) {
  for (const double gamma : {0.0, 1.0, 5.0, 25.0}) {
    const double G = 3 * gamma / (4 * pi);
    EXPECT_NEAR(std::pow(frequency_at_rest(elastic_sl3({G})), 2), 10 + 0.8 * gamma, 1e-7);
  }
}

/// PHYSICS section 5: periods from rest at ℓ₀ of the fluid, in 1/√(πGρ), to the digits printed.
TEST(GravitatingOscillation, PeriodsOfTheFluidFromRest) {
  const auto fluid = fluid_sl3({fluid_time_G});
  EXPECT_NEAR(turning_point(fluid, 1.1, 2).t, 6.1075949317888, 2e-13);
  EXPECT_NEAR(turning_point(fluid, 1.5, 2).t, 6.5285414433944, 2e-13);
  EXPECT_NEAR(turning_point(fluid, 2, 2).t, 7.4368532918857, 2e-13);
}

/// PHYSICS section 5: ω/ω₀ = 1 − (1013/2352)A².
TEST(GravitatingOscillation, FrequencyOfTheFluidFallsWithTheSquareOfTheAmplitude) {
  EXPECT_NEAR(frequency_shift(fluid_sl3({fluid_time_G}), std::sqrt(16.0 / 15)), -1013.0 / 2352, 1e-5);
}

/// T of the force function ψ₀r²P₂.
Matrix3d tide(double psi) { return diagonal(psi, psi, -2 * psi); }

/// PHYSICS section 4: a tide ψ₀r²P₂ lifts the surface by h₂ψ₀a²/g P₂ with h₂ = (5/2)/(1 + 25μ/(2ρga)), that is by
/// ε = ℓ − 1 at the pole; the mean of ±ψ₀ has an error of (ψ₀/g)².
TEST(Tide, StaticStretch) {
  const auto h_2 = [](const auto& body_in, double g) {
    const double psi = 1e-4 * g;
    const double l_plus = spheroid_at_rest(body_in(tide(psi)), 1), l_minus = spheroid_at_rest(body_in(tide(-psi)), 1);
    return g * (l_plus - l_minus) / (2 * psi);
  };
  for (const double G : {0.03, 0.3, 3.0}) {
    const double g = 4 * pi * G / 3;
    const double elastic = h_2([&](const Matrix3d& T) { return elastic_sl3({G, T}); }, g);
    EXPECT_NEAR(elastic, 2.5 / (1 + 25 / (2 * g)), 1e-6);
    const double fluid = h_2([&](const Matrix3d& T) { return fluid_sl3({G, T}); }, g);
    EXPECT_NEAR(fluid, 2.5, 1e-6);
  }
}

/// The force of the potential at that stretch leaves the body at rest: all of the load, not its axial part only.
TEST(Tide, StretchedBodyStaysAtRest) {
  const auto body = elastic_sl3({0.3, tide(0.4)});
  const double l = spheroid_at_rest(body, 1);
  EXPECT_GT(l, 1.05);
  const auto end = state_at(body, moving<LoadedSl3>(spheroid(l), Matrix3d::Zero()), 10, 400);
  EXPECT_LT((end.q - spheroid(l)).norm(), 1e-12);
}

/// T of a centrifugal force.
Matrix3d centrifugal(double Omega) { return diagonal(-Omega * Omega, -Omega * Omega, 0); }

/// PHYSICS section 4: ellipticity (a₁ − a₃)/a = (1/10)Ω²a²/c² of a slow spin, from the static figure in the centrifugal
/// potential; and Ω² = κ(1 − ℓ³) at any spin.
TEST(Spin, FigureInTheCentrifugalPotential) {
  const auto body = [](double Omega) { return elastic_sl3({0, centrifugal(Omega)}); };
  const double slow = 0.01, l = spheroid_at_rest(body(slow), 1);
  EXPECT_NEAR((1 / std::sqrt(l) - l) / (slow * slow), 0.1, 1e-5);  // next term O(Ω²) = 1e-4 of it
  for (const double Omega : {0.5, 1.5, 2.1}) {
    const double figure = spheroid_at_rest(body(Omega), 0.7);
    EXPECT_NEAR(Omega * Omega, kappa * (1 - std::pow(figure, 3)), 1e-12);
  }
}

/// PHYSICS section 6, Maclaurin: Ω²/πGρ = 2√(1−e²)(3−2e²)asin(e)/e³ − 6(1−e²)/e², and with elasticity κ(1 − ℓ³) is
/// added to Ω², ℓ³ = √(1−e²).
TEST(Spin, GravitatingSpheroids) {
  for (const double e : {0.2, 0.5, 0.812670011, 0.95}) {
    const double c = std::sqrt(1 - e * e), l = std::pow(c, 2.0 / 3);
    const double maclaurin = 2 * c * (3 - 2 * e * e) * std::asin(e) / (e * e * e) - 6 * c * c / (e * e);
    EXPECT_NEAR(std::pow(steady_spin(fluid_sl3({fluid_time_G}), l), 2), maclaurin, 1e-13);
    const double both = maclaurin + kappa * (1 - l * l * l);
    EXPECT_NEAR(std::pow(steady_spin(elastic_sl3({fluid_time_G}), l), 2), both, 1e-13);
  }
}

/// They are motions: the spheroid turns rigidly for ten turns and more.
TEST(Spin, GravitatingSpheroidsTurnSteadily) {
  const double l = 0.8;
  for (const auto& body : {fluid_sl3({fluid_time_G}), elastic_sl3({fluid_time_G})}) {
    const auto start = spinning_spheroid(body, l);
    const double Omega = steady_spin(body, l), end = 20 * pi / Omega;
    const auto r = run<mechanics::Rattle8>(body, start, end, 50, 20);
    ASSERT_TRUE(r.finished()) << r.result.reason;
    for (const auto& s : r.states) {
      EXPECT_LT((s.q - rotation_z(Omega * s.t) * start.q).norm(), 1e-9);
      EXPECT_LT((observed(body, s).semi_axes - observed(body, start).semi_axes).norm(), 1e-11);
    }
  }
}

}  // namespace
}  // namespace pseudorigid::testing
