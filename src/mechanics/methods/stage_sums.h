#pragma once
/// Sums of stages with coefficients known to the compiler: Σ_j c_j k_j, entry by entry, zeros left out. The entries of
/// dense Eigen vectors are walked once for all sums of a stage, and no temporary vector is made.

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace pseudorigid::mechanics::detail {

/// Σ_j c_j k_j at entry i. With `c` a constexpr variable the loop becomes its terms that are not zero.
template <class V, std::size_t n>
[[gnu::always_inline]] inline double stage_sum(const std::array<double, n>& c, const std::array<V, n>& k,
                                               Eigen::Index i) {
  double sum = 0;
#pragma GCC unroll 16
  for (std::size_t j = 0; j < n; ++j)
    if (c[j] != 0) sum += c[j] * k[j].data()[i];
  return sum;
}

}  // namespace pseudorigid::mechanics::detail
