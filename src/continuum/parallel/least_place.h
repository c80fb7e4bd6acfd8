#pragma once
/// A least value with its place. If the values at several places agree to 1e-6, as at symmetric places up to round-off,
/// the place with the greatest x counts, then y, then z. So the result does not depend on round-off or on the number of
/// ranks.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pseudorigid::continuum {

struct LeastPlace {
  double value = std::numeric_limits<double>::infinity();
  std::array<double, 3> where{};

  /// A NaN is less than all.
  void take(double other, const std::array<double, 3>& there) {
    if (std::isnan(value)) return;
    const double tie = 1e-6 * std::abs(other);
    if (std::isnan(other) || other < value - tie || (other <= value + tie && is_greater(there, where))) where = there;
    value = std::isnan(other) ? other : std::min(value, other);
  }

 private:
  static bool is_greater(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    for (int c = 0; c < 3; ++c)
      if (std::abs(a[c] - b[c]) > 1e-9) return a[c] > b[c];
    return false;
  }
};

}  // namespace pseudorigid::continuum
