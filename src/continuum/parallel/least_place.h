#pragma once
/// A least value with its place (x, y, z). If the values at several places agree to a relative 1e-6, the place with the
/// largest x is chosen. If x is also equal up to 1e-9, y decides, and then z. At symmetric places, such as mirror
/// images, the result therefore does not depend on round-off or on the number of ranks.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pseudorigid::continuum {

struct LeastPlace {
  double value = std::numeric_limits<double>::infinity();
  std::array<double, 3> where{};

  /// Replaces the value and the place if `other` is less. If the two values agree to a relative 1e-6, keeps the smaller
  /// value, and the place that the order of the opening comment prefers. NaN counts as less than every number.
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
