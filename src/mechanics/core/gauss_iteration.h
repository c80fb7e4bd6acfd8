#pragma once
/// The fixed-point iteration that finds the stages of a Gauss step (gauss_16.h). Sources that are compiled for several
/// instruction sets include this header (kernel_builds.h). The eight stages are computed together in the lanes of SIMD
/// vectors. The state at the time t is (q, v), the step is h, and the field gives the acceleration a(t, q, v). With the
/// accelerations a_j of the stages, and the coefficients c_i and A = (a_ij) of gauss_coefficients.h, an iteration is
///
///   v_i = v + h Σ_j a_ij a_j,   q_i = q + h c_i v + h² Σ_j (A²)_ij a_j,   a_i ← a(t + c_i h, q_i, v_i).
///
/// An iteration multiplies the error by a factor O(h), or O(h²) if a does not depend on v. Let δ_k be the largest
/// change of an acceleration in iteration k, and θ = δ_k/δ_{k−1}. The error after this iteration is about θ δ_k. The
/// iteration ends when this error is below the given tolerance or below an eighth of the round-off of the
/// accelerations. It also ends when δ_k is below half of this round-off, or when a δ_k near round-off is not smaller
/// than δ_{k−1}.
///
/// The error of an iteration that ends too early is a smooth function of the state. Unlike rounding errors, such errors
/// of many steps add up. If no tolerance is given, the bounds of the error and of δ_k are therefore both round-off /
/// 4096. The sum of these errors over 10⁷ steps is about as large as the sum of random rounding errors.
///
/// A field in lanes is a struct
///
///     static constexpr int n;                                   number of entries of q
///     template <class T> T operator()(int first_lane, const T* q, const T* v, T* a) const;
///
/// for vectors T with as many lanes as a register. Lane 0 of the vectors is stage `first_lane`. The operator sets a to
/// the acceleration. It returns numbers that are positive in the lanes with an admissible state. The sign of these
/// numbers is checked only at the end of the iteration.

#include <algorithm>
#include <cmath>
#include <cstring>

#include "mechanics/core/gauss_stages.h"
#include "mechanics/core/lanes.h"

namespace pseudorigid::mechanics::detail {

using StageLanes = Lanes<native_lanes>;
inline constexpr int n_lane_groups = gauss::n_stages / native_lanes;

[[gnu::always_inline]] inline StageLanes load_lanes(const double* p) {
  StageLanes x;
  std::memcpy(&x.v, p, sizeof x.v);
  return x;
}
[[gnu::always_inline]] inline void store_lanes(StageLanes x, double* p) { std::memcpy(p, &x.v, sizeof x.v); }
/// Returns s in every lane. The difference s − 0 is exact for s = −0 and compiles to one instruction. The sum 0 + s
/// would change −0 to 0.
[[gnu::always_inline]] inline StageLanes in_all_lanes(double s) { return StageLanes(s - StageLanes::Native{}); }
/// Makes the compiler hold the coefficients x in a register. Otherwise it loads them again for each use, and loads
/// limit the speed.
[[gnu::always_inline]] inline void put_into_register([[maybe_unused]] StageLanes& x) {
#if defined(__x86_64__)
  asm("" : "+v"(x.v));
#endif
}
[[gnu::always_inline]] inline StageLanes absolute_lanes(StageLanes x) {
  typename StageLanes::NativeBits bits;
  std::memcpy(&bits, &x.v, sizeof bits);
  bits &= 0x7fffffffffffffffULL;
  std::memcpy(&x.v, &bits, sizeof bits);
  return x;
}
/// Returns the greater number in each lane. If one of the two numbers is NaN, the result is the number in `b`. The
/// intrinsics compile to one instruction, but a comparison in C++ to two.
[[gnu::always_inline]] inline StageLanes greater_lanes(StageLanes a, StageLanes b) {
#if defined(__AVX512F__)
  return StageLanes(StageLanes::Native(_mm512_maskz_max_pd(0xff, a.v, b.v)));
#elif defined(__AVX__)
  return StageLanes(StageLanes::Native(_mm256_max_pd(a.v, b.v)));
#elif defined(__x86_64__)
  return StageLanes(StageLanes::Native(_mm_max_pd(a.v, b.v)));
#else
  return a.v > b.v ? a.v : b.v;
#endif
}
template <class Native>
[[gnu::always_inline]] inline double greatest_lane(Native x) {
  if constexpr (sizeof(Native) == 8 * sizeof(double)) {
    const auto low = __builtin_shufflevector(x, x, 0, 1, 2, 3), high = __builtin_shufflevector(x, x, 4, 5, 6, 7);
    return greatest_lane(low > high ? low : high);
  } else if constexpr (sizeof(Native) == 4 * sizeof(double)) {
    const auto low = __builtin_shufflevector(x, x, 0, 1), high = __builtin_shufflevector(x, x, 2, 3);
    return greatest_lane(low > high ? low : high);
  } else {
    return x[0] > x[1] ? x[0] : x[1];
  }
}

[[gnu::always_inline]] inline StageLanes root_of_lanes(StageLanes x) {
#if defined(__AVX512F__)
  return StageLanes(StageLanes::Native(_mm512_maskz_sqrt_pd(0xff, x.v)));
#elif defined(__AVX__)
  return StageLanes(StageLanes::Native(_mm256_sqrt_pd(x.v)));
#elif defined(__x86_64__)
  return StageLanes(StageLanes::Native(_mm_sqrt_pd(x.v)));
#else
  return StageLanes::of([&](int lane) { return std::sqrt(x[lane]); });
#endif
}

/// Adds the first n_groups groups of lanes of Σ_j x_j column_j to `sum`. `columns` contains one vector for each j. A
/// group has native_lanes lanes. The index j runs over the eight stages.
template <int n_groups, class Columns>
[[gnu::always_inline]] inline void add_columns(const OfStages& x, const Columns& columns, StageLanes (&sum)[n_groups]) {
#pragma GCC unroll 8
  for (int j = 0; j < gauss::n_stages; ++j) {
    const StageLanes x_j = in_all_lanes(x[j]);
#pragma GCC unroll 4
    for (int g = 0; g < n_groups; ++g) sum[g] += x_j * load_lanes(columns[j].data() + g * native_lanes);
  }
}

/// Sets `out` to Σ_j x_j column_j in the first n_groups groups of lanes, and to 0 in the other lanes.
template <int n_groups = n_lane_groups, class Columns>
[[gnu::always_inline]] inline void combine_columns(const OfStages& x, const Columns& columns, OfStages& out) {
  StageLanes sum[n_groups];
#pragma GCC unroll 4
  for (int g = 0; g < n_groups; ++g) sum[g] = in_all_lanes(0);
  add_columns(x, columns, sum);
#pragma GCC unroll 4
  for (int g = 0; g < n_lane_groups; ++g)
    store_lanes(g < n_groups ? sum[g % n_groups] : in_all_lanes(0), out.data() + g * native_lanes);
}

/// Decides after each iteration if the iteration goes on, is done, or is stuck. The increment is δ_k of this header,
/// and `scale` is the largest acceleration. The iteration is stuck if the increment is not finite, has grown three
/// times, or is not small enough after 60 iterations.
class GaussMonitor {
 public:
  enum Verdict { go_on, done, stuck };

  GaussMonitor(const GaussStages& s, double scale) : tolerance_(s.tolerance), to_round_off_(s.tolerance == 0) {
    double q = 0, v = 0;
    for (int k = 0; k < s.n; ++k) {
      q = std::max(q, std::abs(s.q[k]));
      v = std::max(v, std::abs(s.v[k]));
    }
    // Accelerations of the size unseen_ have a round-off that changes q and v by at most the round-off of q and v.
    unseen_ = std::min(v / std::abs(s.h), q / (s.h * s.h));
    // Bound of the round-off of forces that cancel. Each force has the size ω²q with a frequency ω, and hω ≤ 4
    // (stability_limit in gauss_16.h). The bound is 32 times the round-off 2⁻⁵³ω²q.
    noise_ = 0x1p-44 * q / (s.outer_h * s.outer_h);
    set_scale(scale);
  }
  void set_scale(double scale) { scale_ = std::max(scale, unseen_); }
  double noise() const { return noise_; }

  Verdict judge(double increment) {
    constexpr double epsilon = 0x1p-53;
    constexpr int max_iterations = 60;
    if (!std::isfinite(increment)) return stuck;
    const bool first = n_iterations_ == 0;  // θ is not yet known
    if (first) before_ = twice_before_ = increment;
    // The test θδ ≤ x is written as δ² ≤ x δ_before, because the processor would have to wait for a quotient. Near
    // round-off, rounding errors determine the last θ. The third test therefore uses the θ of the previous iteration.
    const double unseen = (to_round_off_ ? 0x1p-12 : 0.125) * epsilon * scale_;
    if (increment <= (to_round_off_ ? 0x1p-12 : 0.5) * epsilon * scale_ ||
        increment * std::min(increment, before_) <= std::max(unseen, tolerance_) * before_ ||
        increment * std::min(before_, twice_before_) <= unseen * twice_before_)
      return done;
    const bool grows = increment >= before_;
    if (grows && !first && increment <= std::max(0x1p-30 * scale_, noise_)) return done;
    // The first iteration counts as growth. The increment may then grow twice.
    if (grows && ++n_grown_ > 3) return stuck;
    if (++n_iterations_ > max_iterations) return stuck;
    twice_before_ = before_;
    before_ = increment;
    return go_on;
  }

 private:
  double tolerance_;
  bool to_round_off_;
  double unseen_ = 0, noise_ = 0, scale_ = 0, before_ = 0, twice_before_ = 0;
  int n_iterations_ = 0, n_grown_ = 0;
};

/// The parts of q_i − q and v_i − v that do not change during the iteration. Each pointer refers to an array with one
/// OfStages for each entry.
struct StageStarts {
  OfStages *q, *v;
};
/// Sets the arrays of `start`. If s.last is not null, also sets s.a to the guess extrapolated from the last step. The
/// function takes any number of entries, so it is compiled once and not once for each field. The unused template
/// parameter `Vector` gives each instruction set its own function.
template <class Vector = StageLanes>
[[gnu::noinline]] void begin_stages(GaussStages& s, StageStarts start) {
  const int n = s.n;
  const GaussTables& tables = *s.tables;
  // Rounded coefficients define a different method, whose energy drifts. If the stages are iterated to round-off,
  // `start` therefore contains the contributions of the rounding errors of the coefficients. These errors are so small
  // that multiplying them by the guess instead of the final stages is accurate enough.
  const bool to_round_off = s.tolerance == 0;
  if (s.last)
    for (int k = 0; k < n; ++k) combine_columns(s.last[k], tables.guess, s.a[k]);
  for (int k = 0; k < n; ++k) {
    StageLanes low_q[n_lane_groups], low_v[n_lane_groups];
    for (int g = 0; g < n_lane_groups; ++g) low_q[g] = low_v[g] = in_all_lanes(0);
    if (to_round_off) {
      add_columns(s.a[k], tables.a_squared_low, low_q);
      add_columns(s.a[k], tables.a_low, low_v);
    }
#pragma GCC unroll 4
    for (int g = 0; g < n_lane_groups; ++g) {
      const int first = g * native_lanes;
      const StageLanes v = in_all_lanes(s.v[k]);
      store_lanes(low_q[g] + v * load_lanes(tables.c_low.data() + first) + v * load_lanes(tables.c.data() + first),
                  start.q[k].data() + first);
      store_lanes(low_v[g], start.v[k].data() + first);
    }
  }
}

/// Computes q_i and v_i of the entries k, …, k + n_together − 1. These entries share the loaded coefficients. The
/// increments are summed first, and q and v are added last. In the opposite order, the corrections in `start` for the
/// rounding errors of the coefficients would be lost, because q and v are much larger.
template <int n_together>
[[gnu::always_inline]] inline void states_of_entries(const GaussStages& s, int k, StageStarts start, OfStages* q,
                                                     OfStages* v) {
  const GaussTables& tables = *s.tables;
  StageLanes of_q[n_together][n_lane_groups], of_v[n_together][n_lane_groups];
#pragma GCC unroll 2
  for (int e = 0; e < n_together; ++e)
#pragma GCC unroll 4
    for (int g = 0; g < n_lane_groups; ++g) {
      of_q[e][g] = load_lanes(start.q[k + e].data() + g * native_lanes);
      of_v[e][g] = load_lanes(start.v[k + e].data() + g * native_lanes);
    }
#pragma GCC unroll 8
  for (int j = 0; j < gauss::n_stages; ++j) {
    StageLanes to_q[n_lane_groups], to_v[n_lane_groups];
#pragma GCC unroll 4
    for (int g = 0; g < n_lane_groups; ++g) {
      to_v[g] = load_lanes(tables.a[j].data() + g * native_lanes);
      to_q[g] = load_lanes(tables.a_squared[j].data() + g * native_lanes);
      if constexpr (n_together > 1) {
        put_into_register(to_v[g]);
        put_into_register(to_q[g]);
      }
    }
#pragma GCC unroll 2
    for (int e = 0; e < n_together; ++e) {
      const StageLanes a_j = in_all_lanes(s.a[k + e][j]);
#pragma GCC unroll 4
      for (int g = 0; g < n_lane_groups; ++g) {
        of_v[e][g] += a_j * to_v[g];
        of_q[e][g] += a_j * to_q[g];
      }
    }
  }
#pragma GCC unroll 2
  for (int e = 0; e < n_together; ++e)
#pragma GCC unroll 4
    for (int g = 0; g < n_lane_groups; ++g) {
      store_lanes(in_all_lanes(s.q[k + e]) + of_q[e][g], q[k + e].data() + g * native_lanes);
      store_lanes(in_all_lanes(s.v[k + e]) + of_v[e][g], v[k + e].data() + g * native_lanes);
    }
}

/// Computes q_i and v_i of all entries, two entries at a time. If a vector has only two lanes, the registers can hold
/// the sums of only one entry.
template <class Vector = StageLanes>
[[gnu::noinline]] void states_of_stages(const GaussStages& s, StageStarts start, OfStages* q, OfStages* v) {
  int k = 0;
  if constexpr (native_lanes > 2)
    for (; k + 1 < s.n; k += 2) states_of_entries<2>(s, k, start, q, v);
  for (; k < s.n; ++k) states_of_entries<1>(s, k, start, q, v);
}

/// Number of groups of lanes that contain the sums before velocity_low in GaussSum. The later sums contain only
/// rounding errors, and are needed only if the stages are iterated to round-off.
inline constexpr int n_groups_without_low = (velocity_low + native_lanes - 1) / native_lanes;

/// Computes s.sums, which contain the increments of q and v in the step. Sets s.tail to the largest |Legendre
/// coefficient| of order 6 or 7, divided by the larger of s.scale and `noise`. Sets s.converged to true if all
/// increments are finite, otherwise to false. A NaN may be missing in s.tail, because std::max may ignore it.
template <class Vector = StageLanes>
[[gnu::noinline]] void finish_stages(GaussStages& s, double noise) {
  const int n = s.n;
  double tail = 0, size = 0;
  for (int k = 0; k < n; ++k) {
    if (s.tolerance == 0)
      combine_columns(s.a[k], s.tables->sums, s.sums[k]);
    else
      combine_columns<n_groups_without_low>(s.a[k], s.tables->sums, s.sums[k]);
    tail = std::max({tail, std::abs(s.sums[k][legendre_6]), std::abs(s.sums[k][legendre_7])});
    size += std::abs(s.sums[k][velocity]) + std::abs(s.sums[k][position]);
  }
  s.tail = tail > 0 ? tail / std::max(s.scale, noise) : 0;
  s.converged = std::isfinite(size);
}

/// Runs the iteration for a field in lanes. After success s.converged is true. It is false if the iteration is stuck,
/// if a stage is not admissible, or if an increment is not finite.
template <class Field>
void iterate_in_lanes(const Field& field, GaussStages& s) {
  constexpr int n = Field::n;
  alignas(64) OfStages start_q[n], start_v[n], q[n], v[n];
  const StageStarts start{start_q, start_v};
  begin_stages(s, start);
  GaussMonitor monitor(s, s.scale);
  s.converged = false;
  for (bool first = true;; first = false) {
    states_of_stages(s, start, q, v);
    StageLanes change = in_all_lanes(0), reserve = in_all_lanes(HUGE_VAL);
#pragma GCC unroll 1  // not unrolled, so that the code of the field is compiled only once
    for (int g = 0; g < n_lane_groups; ++g) {
      StageLanes q_i[n], v_i[n], a_i[n];
#pragma GCC unroll 12
      for (int k = 0; k < n; ++k) {
        q_i[k] = load_lanes(q[k].data() + g * native_lanes);
        v_i[k] = load_lanes(v[k].data() + g * native_lanes);
      }
      reserve = min(reserve, field(g * native_lanes, q_i, v_i, a_i));
#pragma GCC unroll 12
      for (int k = 0; k < n; ++k) {
        double* const a = s.a[k].data() + g * native_lanes;
        change = greater_lanes(change, absolute_lanes(a_i[k] - load_lanes(a)));
        store_lanes(a_i[k], a);
      }
    }
    ++s.n_iterations;
    if (first) {
      StageLanes size = in_all_lanes(0);
      for (int k = 0; k < n; ++k)
        for (int g = 0; g < n_lane_groups; ++g)
          size = greater_lanes(size, absolute_lanes(load_lanes(s.a[k].data() + g * native_lanes)));
      monitor.set_scale(s.scale = greatest_lane(size.v));
    }
    const auto verdict = monitor.judge(greatest_lane(change.v));
    if (verdict == GaussMonitor::go_on) continue;
    if (verdict == GaussMonitor::stuck || !(reserve.least(native_lanes) > 0)) return;
    break;
  }
  finish_stages(s, monitor.noise());
}

/// Runs the iteration for a field that is evaluated by a virtual function. After success s.converged is true. It is
/// false if the iteration is stuck, if the field fails, or if an increment is not finite.
inline void iterate_by_calls(const GaussField& field, GaussStages& s) {
  const StageStarts start{s.scratch, s.scratch + s.n};
  OfStages *const q = start.v + s.n, *const v = q + s.n, *const a = v + s.n;
  begin_stages(s, start);
  GaussMonitor monitor(s, s.scale);
  s.converged = false;
  for (bool first = true;; first = false) {
    states_of_stages(s, start, q, v);
    ++s.n_iterations;
    if (!field.evaluate(s, q, v, a)) return;
    double change = 0, size = 0;
    for (int k = 0; k < s.n; ++k)
      for (std::size_t i = 0; i < gauss::n_stages; ++i) {
        change = std::max(change, std::abs(a[k][i] - s.a[k][i]));
        if (first) size = std::max(size, std::abs(a[k][i]));
        s.a[k][i] = a[k][i];
      }
    if (first) monitor.set_scale(s.scale = size);
    const auto verdict = monitor.judge(change);
    if (verdict == GaussMonitor::stuck) return;
    if (verdict == GaussMonitor::done) break;
  }
  finish_stages(s, monitor.noise());
}

}  // namespace pseudorigid::mechanics::detail
