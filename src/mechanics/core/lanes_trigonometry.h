#pragma once
/// Sine and cosine of a vector of lanes (lanes.h), with an error of about one unit in the last place. The reduction is
///
///   x = kπ/2 + r,   |r| ≤ π/4
///
/// with an integer k. The code represents π/2 as a sum of three numbers. The products of k with the first two numbers
/// are exact. The polynomials for sin r and cos r are from fdlibm (Sun Microsystems 1993). If |x| > 2²⁰ or x is NaN in
/// a lane, `sine_cosine` computes all lanes by the C++ library.

#include <cmath>
#include <cstring>

#include "mechanics/core/lanes.h"

namespace pseudorigid::mechanics {

struct SineCosine {
  Lanes<native_lanes> sine, cosine;
};

/// Returns true if |x| ≤ bound in all lanes, and false if a lane is NaN. The intrinsics are used because a loop over
/// the lanes would take longer than a sine.
[[gnu::always_inline]] inline bool all_within(Lanes<native_lanes> x, double bound) {
#if defined(__AVX512F__)
  return _mm512_cmp_pd_mask(_mm512_abs_pd(x.v), _mm512_set1_pd(bound), _CMP_LE_OQ) == 0xff;
#elif defined(__AVX__)
  const __m256d size = _mm256_andnot_pd(_mm256_set1_pd(-0.0), x.v);
  return _mm256_movemask_pd(_mm256_cmp_pd(size, _mm256_set1_pd(bound), _CMP_LE_OQ)) == 0xf;
#else
  bool within = true;
  for (int lane = 0; lane < native_lanes; ++lane) within = within && std::abs(x[lane]) <= bound;
  return within;
#endif
}

/// Largest |x| for which the reduction is accurate. The integer k then has at most 20 bits, so its products with the
/// first two of the three numbers for π/2 are exact.
inline constexpr double most_of_moderate = 0x1p20;

/// Returns the sine and the cosine in each lane. The results are wrong in lanes with |x| > most_of_moderate.
[[gnu::always_inline]] inline SineCosine sine_cosine_of_moderate(Lanes<native_lanes> x) {
  using Vector = Lanes<native_lanes>;
  using Native = Vector::Native;
  using Bits = Vector::NativeBits;
  constexpr double to_integer = 0x1.8p52;
  const Native shifted = x.v * 0.63661977236758134308 + to_integer, k = shifted - to_integer;
  Bits quadrant;
  std::memcpy(&quadrant, &shifted, sizeof quadrant);
  const Native r = ((x.v - k * 1.57079632673412561417e+00) - k * 6.07710050630396597660e-11) -
                   k * 2.02226624879595063154e-21,
               z = r * r;
  const Native sine_tail =
      -1.66666666666666324348e-01 +
      z * (8.33333333332248946124e-03 +
           z * (-1.98412698298579493134e-04 +
                z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10))));
  const Native cosine_tail =
      4.16666666666666019037e-02 +
      z * (-1.38888888888741095749e-03 +
           z * (2.48015872894767294178e-05 +
                z * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 - z * 1.13596475577881948265e-11))));
  const Native of_sine = r + r * z * sine_tail, of_cosine = 1.0 - (0.5 * z - z * z * cosine_tail);
  const Native sine = (quadrant & 1) != 0 ? of_cosine : of_sine, cosine = (quadrant & 1) != 0 ? of_sine : of_cosine;
  return {Vector(Native((quadrant & 2) != 0 ? -sine : sine)),
          Vector(Native(((quadrant + 1) & 2) != 0 ? -cosine : cosine))};
}

/// Returns the sine and the cosine in each lane, for any x.
[[gnu::always_inline]] inline SineCosine sine_cosine(Lanes<native_lanes> x) {
  using Vector = Lanes<native_lanes>;
  if (!all_within(x, most_of_moderate)) [[unlikely]]
    return {Vector::of([&](int l) { return std::sin(x[l]); }), Vector::of([&](int l) { return std::cos(x[l]); })};
  return sine_cosine_of_moderate(x);
}

}  // namespace pseudorigid::mechanics
