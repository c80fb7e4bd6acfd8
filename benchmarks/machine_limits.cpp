#include "machine_limits.h"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "measuring.h"
#include "mechanics/core/lanes.h"

namespace pseudorigid::benchmarks {
namespace {

using mechanics::native_lanes;
using Native = mechanics::Lanes<native_lanes>::Native;

/// The value is needed, and nothing is known of it.
[[gnu::always_inline]] inline void keep(Native& value) { asm volatile("" : "+v"(value)); }

/// Best of some runs, in seconds.
template <class Run>
double best_time(int n_runs, const Run& run) {
  double best = 1e300;
  for (int i = 0; i < n_runs; ++i) best = std::min(best, cpu_seconds(run));
  return best;
}

/// Sixteen chains of s ← s a + b, each in a register: enough to hide the latency.
template <std::size_t... chain>
double measure_flops(std::index_sequence<chain...>) {
  constexpr int n_rounds = 2'000'000;
  const double seconds = best_time(10, [] {
    const Native a = Native{} + 0.999999, b = Native{} + 1e-6;
    std::tuple s{Native{} + 1.0 * chain...};
    for (int round = 0; round < n_rounds; ++round) {
      ((std::get<chain>(s) = std::get<chain>(s) * a + b), ...);
      (keep(std::get<chain>(s)), ...);
    }
  });
  return 2.0 * native_lanes * sizeof...(chain) * n_rounds / seconds;
}

double measure_bandwidth() {
  constexpr std::size_t size = 1 << 24;  // 128 MB a vector
  std::vector<double> a(size, 0.0), b(size, 1.0), c(size, 2.0);
  const double seconds = best_time(8, [&] {
    for (std::size_t i = 0; i < size; ++i) a[i] = b[i] + 0.5 * c[i];
    asm volatile("" : : "r"(a.data()) : "memory");
  });
  return 24.0 * size / seconds;
}

}  // namespace

MachineLimits measure_machine_limits() {
  return {native_lanes, measure_flops(std::make_index_sequence<16>()), measure_bandwidth()};
}

}  // namespace pseudorigid::benchmarks
