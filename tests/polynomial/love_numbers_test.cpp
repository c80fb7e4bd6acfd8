/// Love numbers of polynomial balls. Degree N has the exact numbers of all tides of a degree below N, and degree 1 has
/// the numbers of the pseudo-rigid ball.

#include "polynomial/love_numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pseudorigid::testing {
namespace {

using gravity::LoveNumbers;

std::vector<LoveNumbers> numbers_of(int N, const std::vector<int>& degrees, double gamma) {
  polynomial::BodySetup setup{.degree = N};
  setup.loads.get<loads::SelfGravity>().constant = 3 * gamma / (4 * std::numbers::pi);
  std::vector<LoveNumbers> numbers;
  const auto status = polynomial::love_numbers(setup, degrees, numbers);
  EXPECT_TRUE(status) << status.reason();
  return numbers;
}

TEST(LoveNumbers, ExactValuesAreThoseOfTheLiterature) {
  const LoveNumbers two = gravity::exact_love_numbers(2, 1);
  EXPECT_NEAR(two.h, 2.5 / (1 + 9.5), 1e-15);  // Thomson 1863
  EXPECT_NEAR(two.k(), 1.5 / (1 + 9.5), 1e-15);
  EXPECT_NEAR(two.l, 0.75 / (1 + 9.5), 1e-15);
  // A fluid yields to a load until it floats: h' = −(2n + 1)/3, k' = −1.
  for (const int n : {2, 5, 8}) {
    const LoveNumbers fluid = gravity::exact_love_numbers(n, 1e300);
    EXPECT_NEAR(fluid.load_factor() * fluid.h, -(2 * n + 1) / 3.0, 1e-14);
    EXPECT_NEAR(fluid.load_factor() * fluid.k(), -1, 1e-14);
  }
}

TEST(LoveNumbers, PolynomialsAreExactFromOneDegreeMoreThanTheTide) {
  for (const double gamma : {0.1, 1.0, 100.0})
    for (const LoveNumbers& found : numbers_of(9, {2, 3, 4, 5, 6, 7, 8}, gamma)) {
      const LoveNumbers exact = gravity::exact_love_numbers(found.degree, gamma);
      EXPECT_NEAR(found.h / exact.h, 1, 1e-12) << found.degree << " gamma " << gamma;
      EXPECT_NEAR(found.l / exact.l, 1, 1e-11) << found.degree << " gamma " << gamma;
    }
}

TEST(LoveNumbers, DegreeOneIsThePseudoRigidBall) {
  for (const double gamma : {0.1, 1.0, 100.0})
    for (const LoveNumbers& found : numbers_of(1, {2, 3, 4}, gamma)) {
      const LoveNumbers exact = gravity::pseudo_rigid_love_numbers(found.degree, gamma);
      EXPECT_NEAR(found.h, exact.h, 1e-13) << found.degree << " gamma " << gamma;
      EXPECT_NEAR(found.l, exact.l, 1e-13) << found.degree << " gamma " << gamma;
    }
}

/// K is restricted, so the response to a tide can only be too small, and grows with the degree.
TEST(LoveNumbers, ResponseRisesWithTheDegree) {
  constexpr double gamma = 1;
  double before = 0;
  for (const int N : {3, 4, 5, 6}) {
    const double h = numbers_of(N, {5}, gamma).front().h;
    EXPECT_GE(h, before - 1e-13) << N;
    EXPECT_LE(h, gravity::exact_love_numbers(5, gamma).h + 1e-13) << N;
    before = h;
  }
}

}  // namespace
}  // namespace pseudorigid::testing
