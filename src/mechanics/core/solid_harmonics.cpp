#include "mechanics/core/solid_harmonics.h"

#include <cmath>
#include <cstdlib>
#include <numbers>

namespace pseudorigid::mechanics {
namespace {

/// Returns at [l][m], for 0 ≤ m ≤ l ≤ N, the common factor of r^l Y_lm and r^l Y_{l,−m}. The other factor is Re (x +
/// iy)^m or Im (x + iy)^m. The arguments z and r2 = r² are jets with respect to the position (x, y, z), and r is the
/// distance from the origin.
std::vector<std::vector<Jet>> polar_factors(int N, const Jet& z, const Jet& r2) {
  std::vector<std::vector<Jet>> factor(N + 1, std::vector<Jet>(N + 1));
  factor[0][0] = constant(std::sqrt(1 / (4 * std::numbers::pi)));
  for (int m = 1; m <= N; ++m) {
    // The factor √2 is needed because cos mφ and sin mφ replace e^{±imφ} for m > 0.
    const double of_two_functions = m == 1 ? std::numbers::sqrt2 : 1.0;
    factor[m][m] = of_two_functions * std::sqrt((2.0 * m + 1) / (2.0 * m)) * factor[m - 1][m - 1];
  }
  for (int m = 0; m <= N; ++m)
    for (int l = m + 1; l <= N; ++l) {
      const double a = std::sqrt((4.0 * l * l - 1) / (l * l - m * m));
      factor[l][m] = a * z * factor[l - 1][m];
      if (l - 1 == m) continue;
      const double b = std::sqrt(((l - 1.0) * (l - 1) - m * m) / (4.0 * (l - 1) * (l - 1) - 1));
      factor[l][m] = factor[l][m] + (-a * b) * r2 * factor[l - 2][m];
    }
  return factor;
}

}  // namespace

std::vector<std::vector<Jet>> solid_harmonics(int N, const std::array<double, 3>& at) {
  const Jet x{at[0], {1, 0, 0}}, y{at[1], {0, 1, 0}}, z{at[2], {0, 0, 1}}, r2 = x * x + y * y + z * z;
  std::vector<Jet> real{constant(1)}, imaginary{constant(0)};  // real and imaginary parts of (x + iy)^m
  for (int m = 1; m <= N; ++m) {
    real.push_back(x * real[m - 1] + (-1.0) * y * imaginary[m - 1]);
    imaginary.push_back(x * imaginary[m - 1] + y * real[m - 1]);
  }
  const auto factor = polar_factors(N, z, r2);
  std::vector<std::vector<Jet>> solid(N + 1);
  for (int l = 0; l <= N; ++l)
    for (int m = -l; m <= l; ++m) solid[l].push_back(factor[l][std::abs(m)] * (m < 0 ? imaginary[-m] : real[m]));
  return solid;
}

}  // namespace pseudorigid::mechanics
