/// The functions of scalars that laws use, against extended precision.

#include "materials/scalar.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pseudorigid::materials {
namespace {

/// Numbers of both signs over all sizes from 2⁻⁵² to 1/2, dense about 2⁻¹¹ and 1/4, where other formulas begin.
template <class Use>
void at_departures_from_one(const Use& use) {
  for (double size = 0x1p-52; size <= 0.5; size *= 1.0625)
    for (const double delta : {size, -size}) use(delta);
}

TEST(Scalar, LogNearOneIsTheLogarithm) {
  at_departures_from_one([](double delta) {
    const double J = 1 + delta;
    const long double exact = std::log1p(static_cast<long double>(J) - 1);
    EXPECT_NEAR(log_near_one(J), exact, 4e-16 * std::abs(static_cast<double>(exact))) << J;
  });
  EXPECT_EQ(log_near_one(1.0), 0);
  EXPECT_EQ(log_near_one(7.5), std::log(7.5));
  EXPECT_TRUE(std::isnan(log_near_one(std::nan(""))));
}

TEST(Scalar, LogNearOneOfExtendedPrecisionKeepsItsDigits) {
  at_departures_from_one([](double delta) {
    const long double J = 1.0L + delta / 1024;
    const long double exact = std::log1p(J - 1);
    EXPECT_NEAR(log_near_one(J), exact, 4e-16 * std::abs(static_cast<double>(exact))) << delta;
  });
}

TEST(Scalar, DifferenceFromTheLogarithmDoesNotCancel) {
  at_departures_from_one([](double x) {
    // x²/2 − x³/3 + … where the difference itself has lost its digits in extended precision as well.
    const long double z = x, series = z * z * (0.5L - z * (1.0L / 3 - z * (0.25L - z / 5)));
    const long double exact = std::abs(x) < 1e-4 ? series : z - std::log1p(z);
    EXPECT_NEAR(x_minus_log1p(x), exact, 2e-15 * static_cast<double>(exact)) << x;
  });
}

TEST(Scalar, SettlesAtOneWithinRoundOffAlone) {
  EXPECT_EQ(settled_at_one(1 + 0x1p-49), 1);
  EXPECT_EQ(settled_at_one(1 - 0x1p-49), 1);
  EXPECT_EQ(settled_at_one(1 + 0x1p-47), 1 + 0x1p-47);
  EXPECT_EQ(settled_at_one(1 - 0x1p-47), 1 - 0x1p-47);
}

}  // namespace
}  // namespace pseudorigid::materials
