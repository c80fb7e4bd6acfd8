/// The exact frequencies of the sphere: against tables, and against each other where one equation becomes the other.

#include "analysis/sphere_frequencies.h"

#include <gtest/gtest.h>

#include <numbers>

namespace pseudorigid::testing {
namespace {

using analysis::compressible_sphere_frequency;
using analysis::sphere_frequency;

/// PHYSICS section 7; for λ = μ the lowest modes of Love's table, 0T2, 0S2 and 0S0.
TEST(SphereFrequencies, AreThoseOfTheTables) {
  EXPECT_NEAR(sphere_frequency(true, 2, 0), 2.665622189236, 1e-11);
  const double ratio = 1 / std::numbers::sqrt3;
  EXPECT_NEAR(compressible_sphere_frequency(false, 2, 0, ratio), 2.501, 1e-3);
  EXPECT_NEAR(compressible_sphere_frequency(true, 2, 0, ratio), 2.640, 1e-3);
  EXPECT_NEAR(compressible_sphere_frequency(true, 0, 0, ratio) * ratio / std::numbers::pi, 0.8160, 1e-4);
}

/// As c/c_p → 0 the compressible equation becomes the incompressible one, with a difference of order (c/c_p)².
TEST(SphereFrequencies, OfANearlyIncompressibleSphere) {
  for (const int n : {1, 2, 3, 5})
    for (const int overtone : {0, 1}) {
      const double limit = sphere_frequency(true, n, overtone);
      const double a = compressible_sphere_frequency(true, n, overtone, 0.02) - limit;
      const double b = compressible_sphere_frequency(true, n, overtone, 0.01) - limit;
      EXPECT_LT(std::abs(b), 1e-3) << n;
      EXPECT_NEAR(a / b, 4, 0.05) << n;
    }
}

}  // namespace
}  // namespace pseudorigid::testing
