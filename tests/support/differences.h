#pragma once
/// Central differences of order 8 on equidistant points: f(k) is the value at the distance k h from the centre, k from
/// −4 to 4. Values are numbers or matrices (not expressions of them).

#include <type_traits>

#include "mechanics/core/central_difference.h"

namespace pseudorigid::testing {

/// f′
template <class F>
auto first_difference(const F& f, double h) {
  auto derivative = f(0);
  const auto value_at = [&f](double k, auto& value) {
    value = f(static_cast<int>(k));
    return mechanics::Status();
  };
  (void)mechanics::central_difference(value_at, 1, derivative);
  return std::decay_t<decltype(f(0))>(derivative / h);
}

/// f″
template <class F>
auto second_difference(const F& f, double h) {
  using Value = std::decay_t<decltype(f(0))>;
  return Value(((-205.0 / 72) * f(0) + (8.0 / 5) * (f(1) + f(-1)) - (1.0 / 5) * (f(2) + f(-2)) +
                (8.0 / 315) * (f(3) + f(-3)) - (1.0 / 560) * (f(4) + f(-4))) /
               (h * h));
}

}  // namespace pseudorigid::testing
