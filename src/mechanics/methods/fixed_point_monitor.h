#pragma once
/// Test for the end of a fixed-point iteration x ← Φ(x). The increments are the norms of Φ(x) − x. If the iteration
/// converges, they decrease by about a constant factor until they consist of round-off.

#include <algorithm>
#include <cmath>

#include "mechanics/methods/rattle.h"

namespace pseudorigid::mechanics::detail {

/// Decides after each increment if the iteration is done, goes on, or is stuck. `stalled` detects that the increments
/// no longer decrease because of round-off.
struct FixedPointMonitor {
  static constexpr int max_iterations = 150;
  double previous = HUGE_VAL, least = HUGE_VAL;
  int iteration = 0, n_since_least = 0;

  /// Records the increment. Returns true if none of the last three increments was smaller than all earlier increments,
  /// and the current increment is at most `limit`.
  bool stalled(double increment, double limit) {
    n_since_least = increment < least ? 0 : n_since_least + 1;
    least = std::min(least, increment);
    return n_since_least >= 3 && increment <= limit;
  }
  /// Forgets all increments; call this function after a change of Φ. The number of iterations is not reset.
  void start_again() {
    previous = least = HUGE_VAL;
    n_since_least = 0;
  }

  /// Judges an increment. `round_off` is the bound of increments that consist of round-off. The iteration is done if
  /// the increment is at most `round_off`. It is also done if the increment is at most 30 · `round_off` and not smaller
  /// than the previous one. The iteration is stuck if an increment of at least 1e-3 internal units is at least ten
  /// times the previous one. It is also stuck after a NaN, or if it is not done after 150 iterations.
  ConvergenceMonitor::Verdict judge(double increment, double round_off) {
    using Verdict = ConvergenceMonitor::Verdict;
    if (increment <= round_off || (increment >= previous && increment <= 30 * round_off)) return Verdict::done;
    // Comparisons with NaN are false, so a NaN counts as stuck.
    if (!(increment < 10 * previous || increment < 1e-3) || ++iteration > max_iterations) return Verdict::stuck;
    previous = increment;
    return Verdict::go_on;
  }
};

}  // namespace pseudorigid::mechanics::detail
