#pragma once
/// Sums Σ_j c_j k_j over the dense Eigen vectors k_j of the stages, with coefficients c_j that are known at compile
/// time. The sums are computed entry by entry, so that a single loop can compute all sums of a stage without a
/// temporary vector. Terms with zero coefficients are omitted.

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace pseudorigid::mechanics::detail {

/// Returns entry i of Σ_j c_j k_j. If `c` is a constexpr variable, the compiled code has only the terms with c_j ≠ 0.
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
