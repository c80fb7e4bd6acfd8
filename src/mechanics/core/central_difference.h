#pragma once
/// Central difference of order 8 with the step h, for a function F of one variable with values in a vector space:
///
///   F′(0) ≈ Σ_{k=1..4} c_k [F(kh) − F(−kh)]/h,   c = (4/5, −1/5, 4/105, −1/280).
///
/// Let F change on the length scale l of its variable, and let h = l/100. Truncation and round-off then cause an error
/// of at most about 10⁻¹³ |F|/l.

#include <array>

#include "mechanics/core/status.h"

namespace pseudorigid::mechanics {

/// Sets `derivative` to F′(0). The function F(s, value) sets `value` to F(s) and returns a Status. If F fails, the
/// function returns this failure, and `derivative` is not valid. On entry `derivative` must have the size of the values
/// of F.
template <class Vector, class Function>
Status central_difference(const Function& F, double h, Vector& derivative) {
  constexpr std::array<double, 4> c{4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
  Vector plus = derivative, minus = derivative;
  derivative *= 0;
  for (int k = 4; k >= 1; --k) {
    if (Status status = F(k * h, plus); !status) return status;
    if (Status status = F(-k * h, minus); !status) return status;
    derivative += c[k - 1] / h * (plus - minus);
  }
  return {};
}

}  // namespace pseudorigid::mechanics
