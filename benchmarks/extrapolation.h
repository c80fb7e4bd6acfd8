#pragma once
/// Extrapolation of the modified midpoint rule (Gragg 1965; Hairer, Nørsett, Wanner II.9) with fixed steps H, for
/// references in extended precision: the midpoint rule with n = 2, 4, …, 2k substeps, whose error is a series in
/// (H/n)², extrapolated to order 2k.

#include <array>
#include <cstddef>

namespace pseudorigid::benchmarks {

template <int k, class Real, std::size_t n, class RightHandSide>
void extrapolated_step(const RightHandSide& f, const Real& H, std::array<Real, n>& y) {
  using Y = std::array<Real, n>;
  const auto moved = [](const Y& x, const Real& h, const Y& rate) {
    Y r = x;
    for (std::size_t i = 0; i < n; ++i) r[i] += h * rate[i];
    return r;
  };
  std::array<Y, k> T;  // the last row of the table
  for (int j = 0; j < k; ++j) {
    const int n_substeps = 2 * (j + 1);
    const Real h = H / n_substeps;
    Y before = y, now = moved(y, h, f(y));
    for (int m = 1; m < n_substeps; ++m) {
      Y next = moved(before, 2 * h, f(now));
      before = now;
      now = next;
    }
    Y diagonal = now;  // Gragg's smoothing is needless for an even number of substeps
    for (int l = 0; l < j; ++l) {
      // T_{j,l+1} = T_{j,l} + (T_{j,l} − T_{j−1,l}) / ((n_j/n_{j−l−1})² − 1)
      const Real ratio = Real(j + 1) / Real(j - l);
      const Real factor = 1 / (ratio * ratio - 1);
      Y refined = diagonal;
      for (std::size_t i = 0; i < n; ++i) refined[i] += factor * (diagonal[i] - T[l][i]);
      T[l] = diagonal;
      diagonal = refined;
    }
    T[j] = diagonal;
  }
  y = T[k - 1];
}

}  // namespace pseudorigid::benchmarks
