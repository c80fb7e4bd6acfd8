/// Deformations that a law does not admit, and the surface limits that laws declare.

#include <gtest/gtest.h>

#include <cmath>

#include "materials/law_table.h"

namespace pseudorigid::materials {
namespace {

Tensor<double> stretched(double l) { return {{{l, 0, 0}, {0, 1 / std::sqrt(l), 0}, {0, 0, 1 / std::sqrt(l)}}}; }

/// I − 3 = l² + 2/l − 3 is 2 at l = 2.
TEST(LawLimits, GentAdmitsWhatIsBelowItsLimit) {
  const AnyLaw law = make_law("gent", {.gent_limit = 2});
  EXPECT_TRUE(admits(law, stretched(1)));
  EXPECT_TRUE(admits(law, stretched(1.999)));
  EXPECT_FALSE(admits(law, stretched(2.001)));
  EXPECT_EQ(beyond_limit(limit_of(law)),
            "the law of the material admits no such deformation: I - 3 has reached Material/Gent limit");
}

TEST(LawLimits, LawsWithoutALimitAdmitEverything) {
  EXPECT_TRUE(limit_of(make_law("neo-hookean", {})).empty());
  for (const NamedLaw& law : law_table)
    EXPECT_EQ(admits(law.make({}), stretched(1e6)), limit_of(law.make({})).empty()) << law.name;
}

/// With J_m → ∞ Gent's law is neo-Hookean: the difference is (μ/4) d²/J_m + ….
TEST(LawLimits, GentIsNeoHookeanFarFromItsLimit) {
  const Tensor<double> F = stretched(1.7);
  const double d = 1.7 * 1.7 + 2 / 1.7 - 3;
  const auto energy = [&](const AnyLaw& law) { return std::visit([&](const auto& l) { return l.energy(F); }, law); };
  const double difference = energy(make_law("gent", {.gent_limit = 1e6})) - energy(make_law("neo-hookean", {}));
  EXPECT_NEAR(difference, d * d / 4 / 1e6, 1e-11);
}

/// Biot's limit is known for the neo-Hookean law, which ciarlet-geymonat is where volume is preserved, and Mooney's.
TEST(LawLimits, SurfaceLimitsAreThoseOfBiot) {
  for (const char* name : {"neo-hookean", "mooney-rivlin", "ciarlet-geymonat", "ciarlet-geymonat (as printed)"})
    EXPECT_EQ(surface_limit(make_law(name, {})), biot_ratio) << name;
  for (const char* name : {"gent", "saint-venant-kirchhoff", "saint-venant-kirchhoff (as printed)", "none"})
    EXPECT_FALSE(surface_limit(make_law(name, {}))) << name;
}

}  // namespace
}  // namespace pseudorigid::materials
