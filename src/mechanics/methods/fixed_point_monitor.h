#pragma once
/// When a fixed-point iteration x ← Φ(x) is at its end: increments fall by a constant factor each time until round-off
/// makes them jitter.

#include <algorithm>
#include <cmath>

#include "mechanics/methods/rattle.h"

namespace pseudorigid::mechanics::detail {

/// Decides on an increment: done, go on, or stuck.
struct FixedPointMonitor {
  static constexpr int max_iterations = 150;
  double previous = HUGE_VAL, least = HUGE_VAL;
  int iteration = 0, n_since_least = 0;

  /// Whether increments have come below a limit and are no longer falling.
  bool stalled(double increment, double limit) {
    n_since_least = increment < least ? 0 : n_since_least + 1;
    least = std::min(least, increment);
    return n_since_least >= 3 && increment <= limit;
  }
  void start_again() {
    previous = least = HUGE_VAL;
    n_since_least = 0;
  }

  ConvergenceMonitor::Verdict judge(double increment, double round_off) {
    using Verdict = ConvergenceMonitor::Verdict;
    if (increment <= round_off || (increment >= previous && increment <= 30 * round_off)) return Verdict::done;
    // A NaN compares false everywhere and is stuck at once; increments below a thousandth of the unit may jitter.
    if (!(increment < 10 * previous || increment < 1e-3) || ++iteration > max_iterations) return Verdict::stuck;
    previous = increment;
    return Verdict::go_on;
  }
};

}  // namespace pseudorigid::mechanics::detail
