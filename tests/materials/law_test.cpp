/// Every law of the table: P = ∂W/∂F by complex step, stress-free at Id, W without cancellation at small strains.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include "materials/law_table.h"

namespace pseudorigid::materials {
namespace {

using Real = Tensor<double>;

/// Id + H with the entries of H within ±size, det > 0; the same for the same seed.
Real near_identity(unsigned seed, double size) {
  std::mt19937 bits(seed);
  Real F;
  for (int k = 0; k < 9; ++k)
    F(k / 3, k % 3) = (k % 4 == 0 ? 1 : 0) + size * (static_cast<double>(bits()) / 2147483648.0 - 1);
  return F;
}

struct NamedLaw {
  std::string name;
  AnyLaw law;
};
class EveryLaw : public ::testing::TestWithParam<NamedLaw> {};

TEST_P(EveryLaw, StressIsTheDerivativeOfTheEnergy) {
  constexpr double increment = 1e-100;  // complex step: no cancellation, so no trade-off
  std::visit(
      [&](const auto& law) {
        for (unsigned seed = 1; seed <= 50; ++seed) {
          const Real F = near_identity(seed, 0.35), P = law.stress(F);
          ASSERT_GT(determinant(F), 0);
          for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
              Tensor<std::complex<double>> z;
              for (int k = 0; k < 9; ++k) z(k / 3, k % 3) = F(k / 3, k % 3);
              z(i, j) += std::complex<double>(0, increment);
              const double derivative = law.energy(z).imag() / increment;
              EXPECT_NEAR(P(i, j), derivative, 1e-12 * std::max(1.0, std::abs(derivative)));
            }
        }
      },
      GetParam().law);
}

TEST_P(EveryLaw, IdentityIsFreeOfStressAndEnergy) {
  std::visit(
      [](const auto& law) {
        const Real Id = near_identity(0, 0);
        EXPECT_EQ(law.energy(Id), 0);
        for (int k = 0; k < 9; ++k) EXPECT_EQ(law.stress(Id)(k / 3, k % 3), 0);
      },
      GetParam().law);
}

TEST_P(EveryLaw, EnergyIsPositiveAndObjective) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  const Real R{{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}};
  std::visit(
      [&](const auto& law) {
        for (unsigned seed = 1; seed <= 20; ++seed) {
          const Real F = near_identity(seed, 0.3);
          Real RF, FR;
          for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
              RF(i, j) = R(i, 0) * F(0, j) + R(i, 1) * F(1, j) + R(i, 2) * F(2, j);
              FR(i, j) = F(i, 0) * R(0, j) + F(i, 1) * R(1, j) + F(i, 2) * R(2, j);
            }
          EXPECT_GT(law.energy(F), 0);
          EXPECT_NEAR(law.energy(RF), law.energy(F), 1e-14);
          EXPECT_NEAR(law.energy(FR), law.energy(F), 1e-14) << "isotropy";
        }
      },
      GetParam().law);
}

INSTANTIATE_TEST_SUITE_P(
    Table, EveryLaw,
    ::testing::Values(NamedLaw{"neo_hookean_incompressible", make_law("neo-hookean", {1.3, 0.8, true})},
                      NamedLaw{"neo_hookean_compressible", make_law("neo-hookean", {1.3, 0.8, false})},
                      NamedLaw{"ciarlet_geymonat", make_law("ciarlet-geymonat", {1.3, 0.8, true})}),
    [](const auto& info) { return info.param.name; });

/// tr Hⁿ, n = 1 … 12.
std::vector<double> traces_of_powers(const Real& H) {
  std::vector<double> traces;
  Real power = H;
  for (int n = 1; n <= 12; ++n) {
    traces.push_back(power(0, 0) + power(1, 1) + power(2, 2));
    Real next;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) next(i, j) = power(i, 0) * H(0, j) + power(i, 1) * H(1, j) + power(i, 2) * H(2, j);
    power = next;
  }
  return traces;
}

TEST(CiarletGeymonat, EnergyIsAccurateAtSmallStrains) {
  // With F = Id + H and ln J = tr H − tr H²/2 + tr H³/3 − …, all terms of order 0 and 1 fall out of
  //   I − 3 − 2 ln J = |H|² + tr H² − (2/3) tr H³ + …,   III − 1 − ln III = e^{2 ln J} − 1 − 2 ln J.
  const CiarletGeymonat law{1.3, 0.8};
  for (const double size : {1e-2, 1e-5, 1e-8, 1e-12})
    for (unsigned seed = 1; seed <= 10; ++seed) {
      const Real F = near_identity(seed, size);
      Real H = F;
      for (int i = 0; i < 3; ++i) H(i, i) -= 1;
      const auto trace = traces_of_powers(H);
      double shear = dot(H, H) + trace[1], x = 2 * trace[0] - trace[1];  // x = 2 ln J = ln III
      for (int n = 3; n <= 12; ++n) {
        const double term = (n % 2 == 0 ? -2.0 : 2.0) / n * trace[static_cast<std::size_t>(n - 1)];
        shear -= term;
        x += term;
      }
      double bulk = 0, term = x;
      for (int n = 2; n <= 12; ++n) bulk += term *= x / n;  // e^x − 1 − x
      const double exact = law.mu / 2 * shear + law.lambda / 4 * bulk;
      EXPECT_NEAR(law.energy(F), exact, 1e-12 * exact) << "size " << size << ", seed " << seed;
    }
}

TEST(CiarletGeymonat, LinearisesToHookesLaw) {  // P = 2μ sym H + λ tr H Id + O(H²)
  const CiarletGeymonat law{1.3, 0.8};
  const double size = 1e-7;
  const Real F = near_identity(3, size), P = law.stress(F);
  const double trace = F(0, 0) + F(1, 1) + F(2, 2) - 3;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double hooke = law.mu * (F(i, j) + F(j, i) - (i == j ? 2 : 0)) + (i == j ? law.lambda * trace : 0);
      EXPECT_NEAR(P(i, j), hooke, 20 * size * size + 1e-15);
    }
}

TEST(LawTable, OnSl3TheNeoHookeanLawHasNoBulkTerm) {
  EXPECT_EQ(std::get<CiarletGeymonat>(make_law("neo-hookean", {1, 2, true})).lambda, 0);
  EXPECT_EQ(std::get<CiarletGeymonat>(make_law("neo-hookean", {1, 2, false})).lambda, 2);
  EXPECT_EQ(std::get<CiarletGeymonat>(make_law("ciarlet-geymonat", {1, 2, true})).lambda, 2);
}

TEST(LawTable, NamesWhatItDoesNotKnow) {
  try {
    (void)make_law("rubber", {});
    FAIL() << "a law called rubber";
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("rubber"), std::string::npos);
  }
}

}  // namespace
}  // namespace pseudorigid::materials
