#pragma once
/// Sums of stages with coefficients known to the compiler: Σ_j c_j k_j, entry by entry, zeros left out. The entries of
/// dense Eigen vectors are walked once for all sums of a stage, and no temporary vector is made.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <utility>

namespace pseudorigid::mechanics::detail {

/// Σ_j c_j k_j at entry i; `Coefficients` is a captureless lambda that returns the constexpr array c.
template <class Coefficients, class V, std::size_t n>
[[gnu::always_inline]] inline double stage_sum(Coefficients, const std::array<V, n>& k, Eigen::Index i) {
  constexpr auto c = Coefficients{}();
  static_assert(c.size() == n);
  double sum = 0;
  const auto add = [&]<std::size_t j>(std::integral_constant<std::size_t, j>) {
    if constexpr (c[j] != 0) sum += c[j] * k[j].data()[i];
  };
  [&]<std::size_t... j>(std::index_sequence<j...>) { (add(std::integral_constant<std::size_t, j>{}), ...); }
  (std::make_index_sequence<n>{});
  return sum;
}

}  // namespace pseudorigid::mechanics::detail
