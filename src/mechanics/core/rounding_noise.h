#pragma once
/// Measured round-off of functions of the state, called noise. The noise is the change of the function if the entries
/// of its arguments change by a few units in their last place. Even a stable computation has an error of this size,
/// which no iteration can reduce.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>

#include "mechanics/core/constrained_system.h"

namespace pseudorigid::mechanics::detail {

/// Adds a_i · unit · size_i to each x_i, with pseudo-random a_i in (−2, 2). `pattern` = 1, 2, … is the seed of the
/// random numbers, so the changes are reproducible.
template <class Vector>
void perturb(double unit, Vector size, int pattern, Vector& x) {
  scale(4 * unit, size);
  // Similar seeds give similar numbers, so the seeds are multiples of a large number.
  std::minstd_rand random(static_cast<unsigned>(pattern) * 7654321U);
  constexpr double range = std::minstd_rand::max();
  const auto units = local_values(size), entries = local_values(x);
  for (std::size_t i = 0; i < entries.size(); ++i)
    entries[i] += units[i] * (static_cast<double>(random()) / range - 0.5);
}

/// Returns the largest |r(pattern) − r(0)|_∞ over the patterns 1 to 8. `evaluate(pattern, r)` sets r to a function of
/// arguments that are changed with this pattern, and returns false if it fails. Pattern 0 means unchanged arguments.
/// Patterns that fail or give a result that is not finite are omitted. Returns 0 if pattern 0 fails.
template <ConstrainedSystem S, class Evaluate>
double largest_change(const S& system, Evaluate&& evaluate) {
  constexpr int n_patterns = 8;
  auto before = system.make_multiplier(), after = before;
  if (!evaluate(0, before)) return 0;
  double largest = 0;
  for (int pattern = 1; pattern <= n_patterns; ++pattern) {
    if (!evaluate(pattern, after)) continue;
    axpy(-1.0, before, after);
    if (const double change = max_norm(after); std::isfinite(change)) largest = std::max(largest, change);
  }
  return largest;
}

/// Relative size of the last place of a number. `last_place` is for a double, and `last_place_kept` is for a
/// compensated sum q + q_rounding, which has at least the precision of a long double.
inline constexpr double last_place = std::numeric_limits<double>::epsilon();
inline constexpr auto last_place_kept = static_cast<double>(std::numeric_limits<long double>::epsilon());

/// Returns the noise of G(q) v, the rate of the constraint g with G = Dg, if q and v change in their last places.
template <ConstrainedSystem S>
[[gnu::cold, gnu::noinline]] double noise_of_rate(const S& system, const typename S::Vector& q,
                                                  const typename S::Vector& v) {
  return largest_change(system, [&](int pattern, auto& r) {
    auto q_near = q, v_near = v;
    if (pattern > 0) {
      perturb(last_place, q, pattern, q_near);
      perturb(last_place, v, pattern + 100, v_near);
    }
    system.constraint_rate(q_near, v_near, r);
    return true;
  });
}

/// Returns the noise of the constraint g(q) if q changes in its last place. Returns 0 if g(q) cannot be evaluated.
template <ConstrainedSystem S>
[[gnu::cold, gnu::noinline]] double noise_of_constraint(const S& system, const typename S::Vector& q) {
  return largest_change(system, [&](int pattern, auto& r) {
    auto q_near = q;
    if (pattern > 0) perturb(last_place, q, pattern, q_near);
    return system.constraint(q_near, r).ok();
  });
}

/// Returns the noise of the constraint g(q + q_rounding) if q_rounding changes by the last place of the sum q +
/// q_rounding. Returns 0 if the constraint cannot be evaluated. The system must compute this constraint with the
/// precision of long double.
template <ConstrainedSystem S>
[[gnu::cold, gnu::noinline]] double noise_of_constraint(const S& system, const typename S::Vector& q,
                                                        const typename S::Vector& q_rounding) {
  return largest_change(system, [&](int pattern, auto& r) {
    auto near = q_rounding;
    if (pattern > 0) perturb(last_place_kept, q, pattern, near);
    return system.constraint(q, near, r).ok();
  });
}

}  // namespace pseudorigid::mechanics::detail
