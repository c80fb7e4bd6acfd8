/// Nonlinear and small oscillations of the pseudo-rigid ball released from rest (PHYSICS sections 3 and 5).

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "mechanics/steps/largest_frequency.h"
#include "reduced/bodies.h"
#include "reduced/turning_point.h"

namespace pseudorigid::testing {
namespace {

const Sl3 pulsating_ball = neo_hookean_sl3();

TEST(Oscillation, PeriodsFromRest) {  // PHYSICS section 5, neo-Hookean, in r/c
  EXPECT_NEAR(turning_point(pulsating_ball, 1.1, 2, 0.05).t, 1.9888587181466, 2e-13);
  EXPECT_NEAR(turning_point(pulsating_ball, 1.5, 2, 0.05).t, 2.0256220163011, 2e-13);
  EXPECT_NEAR(turning_point(pulsating_ball, 2, 2, 0.02).t, 2.1053655444928, 2e-13);
}

TEST(Oscillation, LeastStretchIsWhereThePotentialIsEqual) {  // PHYSICS section 5: ℓ² + 2/ℓ = ℓ₀² + 2/ℓ₀
  EXPECT_NEAR(turning_point(pulsating_ball, 2, 1, 0.05).l, std::numbers::sqrt2 - 1, 1e-11);
}

TEST(Oscillation, SmallOnesHaveTheFrequencySquareRootOfTen) {  // PHYSICS section 3: x = √10
  EXPECT_NEAR(2 * std::numbers::pi / turning_point(pulsating_ball, std::exp(2e-5), 2).t, std::sqrt(10.0), 1e-9);
}

TEST(Oscillation, FrequencyFallsWithTheSquareOfTheAmplitude) {  // PHYSICS section 5: ω/ω₀ = 1 − (5/48)A²
  EXPECT_NEAR(frequency_shift(pulsating_ball, std::sqrt(10.0)), -5.0 / 48, 2e-6);
}

TEST(Frequency, OfTheBodyAtRest) {
  const Sl3 incompressible = neo_hookean_sl3();
  Sl3::Workspace w;
  const auto shear = mechanics::largest_frequency(incompressible, stretched(1), w, 12);
  EXPECT_NEAR(shear.omega, std::sqrt(10.0), 1e-8);  // PHYSICS section 3: x = √10

  // Ḧ = −κ(H + Hᵀ) − 5λ tr(H) Id: the radial mode has ω² = 10 + 15λ.
  const double lambda = 1.7;
  const Gl3 compressible(Law{1, lambda}, reduced::ReferenceBody::unit_ball());
  Gl3::Workspace v;
  const auto radial = mechanics::largest_frequency(compressible, {0, Matrix3d::Identity(), Matrix3d::Zero()}, v, 12);
  EXPECT_NEAR(radial.omega, std::sqrt(10 + 15 * lambda), 1e-8);
}

/// A law with a hydrostatic gauge: W + c ln J.
struct GaugedLaw : Law {
  double c;
  template <class T>
  materials::Tensor<T> stress(const materials::Tensor<T>& F) const {
    materials::Tensor<T> P = Law::stress(F);
    const auto cof = materials::cofactor(F);
    const T J = materials::determinant(F, cof);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) P(i, j) = P(i, j) + c * cof(i, j) / J;
    return P;
  }
};
using GaugedBody = reduced::PseudoRigidBody<GaugedLaw, true>;

TEST(Frequency, DoesNotDependOnTheGaugeOfTheEnergy) {
  const auto start = benchmark_state<Sl3>();
  Sl3::Workspace w;
  const double plain = mechanics::largest_frequency(neo_hookean_sl3(), start, w, 12).omega;
  const GaugedBody gauged({Law{1, 0}, 3.0}, reduced::ReferenceBody::unit_ball());
  GaugedBody::Workspace v;
  EXPECT_NEAR(mechanics::largest_frequency(gauged, {0, start.q, start.v}, v, 12).omega, plain, 1e-7);
}

TEST(Gauge, ShiftsTheMultiplierAndNothingElse) {
  const double c = 1.3;
  const Sl3 plain = neo_hookean_sl3();
  const GaugedBody gauged({Law{1, 0}, c}, reduced::ReferenceBody::unit_ball());
  const auto start = benchmark_state<Sl3>();
  const auto a = run<mechanics::Rattle4>(plain, start, 10, 10, 20);
  const auto b = run<mechanics::Rattle4>(gauged, {0, start.q, start.v}, 10, 10, 20);
  for (std::size_t k = 0; k < a.states.size(); ++k) {
    EXPECT_LT((a.states[k].q - b.states[k].q).norm(), 1e-13);
    EXPECT_NEAR(observed(gauged, b.states[k]).multiplier, observed(plain, a.states[k]).multiplier + kappa * c, 1e-12);
  }
}

TEST(Gauge, BulkTermOfCiarletGeymonatDoesNothingOnSl3) {
  const Sl3 plain = neo_hookean_sl3();
  for (const double lambda : {0.5, 1.0, 20.0}) {
    const Sl3 bulky(Law{1, lambda}, reduced::ReferenceBody::unit_ball());
    const auto a = run<mechanics::Rattle4>(plain, benchmark_state<Sl3>(), 10, 10, 20);
    const auto b = run<mechanics::Rattle4>(bulky, benchmark_state<Sl3>(), 10, 10, 20);
    EXPECT_LT(distance(a, b), 1e-12);
    EXPECT_NEAR(observed(bulky, b.last()).multiplier, observed(plain, a.last()).multiplier, 1e-12);
  }
}

}  // namespace
}  // namespace pseudorigid::testing
