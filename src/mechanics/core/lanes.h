#pragma once
/// A SIMD vector of doubles. Each entry, called a lane, belongs to another cell, quadrature point, body or stage. The
/// type uses the vector extension of the compiler, because the packaged deal.II does not have wide vectors.
///
/// The definitions depend on the instruction set for which a file is compiled. For each number of lanes they are in
/// another inline namespace. The linker therefore does not merge functions of files that are compiled for different
/// numbers of lanes.

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include <cmath>
#include <cstring>
#include <limits>

#if defined(__AVX512F__)
#define PSEUDORIGID_NATIVE_LANES 8
#define PSEUDORIGID_LANES_OF lanes_of_avx512
#elif defined(__AVX__)
#define PSEUDORIGID_NATIVE_LANES 4
#define PSEUDORIGID_LANES_OF lanes_of_avx
#else
#define PSEUDORIGID_NATIVE_LANES 2
#define PSEUDORIGID_LANES_OF lanes_of_two
#endif

namespace pseudorigid::mechanics {
inline namespace PSEUDORIGID_LANES_OF {

/// Number of lanes of the widest vector that this translation unit may use.
inline constexpr int native_lanes = PSEUDORIGID_NATIVE_LANES;

/// Returns the smaller of two numbers. A NaN counts as smaller than any number.
inline double lesser(double a, double b) { return a < b || a != a ? a : b; }

namespace lanes_detail {
template <int n_lanes>
struct VectorTypes;  // specialised below; the compiler ignores a vector size that depends on a template parameter
template <>
struct VectorTypes<2> {
  typedef double Real __attribute__((vector_size(16)));
  typedef long long Integer __attribute__((vector_size(16)));
  typedef unsigned long long Bits __attribute__((vector_size(16)));
};
template <>
struct VectorTypes<4> {
  typedef double Real __attribute__((vector_size(32)));
  typedef long long Integer __attribute__((vector_size(32)));
  typedef unsigned long long Bits __attribute__((vector_size(32)));
};
template <>
struct VectorTypes<8> {
  typedef double Real __attribute__((vector_size(64)));
  typedef long long Integer __attribute__((vector_size(64)));
  typedef unsigned long long Bits __attribute__((vector_size(64)));
};

/// Returns the vector (a, b), joined from two numbers or from two vectors.
[[gnu::always_inline]] inline VectorTypes<2>::Real join(double a, double b) { return VectorTypes<2>::Real{a, b}; }
template <class Half>
[[gnu::always_inline]] inline auto join(Half a, Half b) {
  if constexpr (sizeof(Half) == 2 * sizeof(double))
    return __builtin_shufflevector(a, b, 0, 1, 2, 3);
  else
    return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
}

/// Returns the vector (piece(first), piece(first + 1), …), joined from n pieces. A piece is a number or a vector, and n
/// is a power of two.
template <int n, class Piece>
[[gnu::always_inline]] inline auto collect(const Piece& piece, int first = 0) {
  if constexpr (n == 1)
    return piece(first);
  else
    return join(collect<n / 2>(piece, first), collect<n / 2>(piece, first + n / 2));
}
}  // namespace lanes_detail

template <int n_lanes>
struct Lanes {
  using Native = typename lanes_detail::VectorTypes<n_lanes>::Real;
  using NativeInt = typename lanes_detail::VectorTypes<n_lanes>::Integer;
  using NativeBits = typename lanes_detail::VectorTypes<n_lanes>::Bits;
  using Native2 = typename lanes_detail::VectorTypes<2>::Real;
  Native v;

  Lanes() = default;
  Lanes(Native native) : v(native) {}
  Lanes(double s) : v(Native{} + s) {}

  /// Returns the vector with value(l) in lane l. The vector is built in registers; setting one lane after the other
  /// would access memory.
  template <class Value>
  [[gnu::always_inline]] static Lanes of(const Value& value) {
    return lanes_detail::collect<n_lanes>(value);
  }

  double operator[](int lane) const { return v[lane]; }
  void set(int lane, double value) { v[lane] = value; }

  friend Lanes operator+(Lanes a, Lanes b) { return a.v + b.v; }
  friend Lanes operator-(Lanes a, Lanes b) { return a.v - b.v; }
  friend Lanes operator*(Lanes a, Lanes b) { return a.v * b.v; }
  friend Lanes operator/(Lanes a, Lanes b) { return a.v / b.v; }
  friend Lanes operator+(Lanes a, double b) { return a.v + b; }
  friend Lanes operator-(Lanes a, double b) { return a.v - b; }
  friend Lanes operator*(Lanes a, double b) { return a.v * b; }
  friend Lanes operator*(double a, Lanes b) { return a * b.v; }
  friend Lanes operator/(double a, Lanes b) { return a / b.v; }
  Lanes operator-() const { return -v; }
  Lanes& operator+=(Lanes b) {
    v += b.v;
    return *this;
  }
  /// Returns the smaller number in each lane. A NaN counts as smaller than any number.
  friend Lanes min(Lanes a, Lanes b) { return (a.v < b.v) | (a.v != a.v) ? a.v : b.v; }

  /// Returns the natural logarithm of positive normal numbers, with an error of about one unit in the last place. Other
  /// numbers give wrong results. The computation uses
  ///   x = 2^e m, m in [√½, √2), z = (m−1)/(m+1), ln x = e ln 2 + 2(z + z³/3 + z⁵/5 + …).
  friend Lanes log(Lanes x) {
    NativeBits bits;
    std::memcpy(&bits, &x.v, sizeof bits);
    constexpr unsigned long long sqrt_half_bits = 0x3fe6a09e667f3bcdULL, mantissa_mask = 0x000fffffffffffffULL;
    const NativeBits difference = bits - sqrt_half_bits;  // unsigned, because it may overflow if x is not positive
    const NativeInt exponent = reinterpret_cast<NativeInt>(difference) >> 52;
    const NativeBits mantissa_bits = (difference & mantissa_mask) + sqrt_half_bits;
    Native m;
    std::memcpy(&m, &mantissa_bits, sizeof m);
    const Native z = (m - 1.0) / (m + 1.0), z2 = z * z;
    Native series = Native{} + 1.0 / 23;
    for (int i = 21; i >= 3; i -= 2) series = series * z2 + 1.0 / i;
    const Native e = __builtin_convertvector(exponent, Native);
    return (2 * z + 2 * z * z2 * series) + e * 0.69314718055994530942;
  }

  /// Returns ln(1 + x) for x > −1, without cancellation for small x. With u = 1 + x, the second term of the result
  /// corrects the rounding error of u to first order.
  friend Lanes log1p(Lanes x) {
    const Native u = 1.0 + x.v;
    return log(Lanes(u)).v - ((u - 1.0) - x.v) / u;
  }

  /// Returns 1/√x with an error of about one unit in the last place, for positive x in the range of single precision.
  /// Other x may give wrong numbers. The computation starts from a guess y with 11 or more correct bits. With e = 1 −
  /// xy² the result is y (1 + e/2 + 3e²/8 + 5e³/16 + 35e⁴/128). The instructions for square root and division take
  /// several times as long.
  friend Lanes inverse_sqrt(Lanes x) {
    const Native y = inverse_sqrt_guess(x.v), e = 1.0 - x.v * y * y;
    return y + y * e * (0.5 + e * (0.375 + e * (0.3125 + e * 0.2734375)));
  }

  /// Loads the three numbers at base + offsets[l] into lane l of x, y and z, for each lane l.
  [[gnu::always_inline]] static void load_triples(const double* base, const unsigned int* offsets, Lanes& x, Lanes& y,
                                                  Lanes& z) {
    const auto pair = [&](int lane) {
      Native2 xy;
      std::memcpy(&xy, base + offsets[lane], sizeof xy);
      return xy;
    };
    const Native low = lanes_detail::collect<n_lanes / 2>(pair),
                 high = lanes_detail::collect<n_lanes / 2>(pair, n_lanes / 2);
    if constexpr (n_lanes == 2) {
      x = __builtin_shufflevector(low, high, 0, 2);
      y = __builtin_shufflevector(low, high, 1, 3);
    } else if constexpr (n_lanes == 4) {
      x = __builtin_shufflevector(low, high, 0, 2, 4, 6);
      y = __builtin_shufflevector(low, high, 1, 3, 5, 7);
    } else {
      x = __builtin_shufflevector(low, high, 0, 2, 4, 6, 8, 10, 12, 14);
      y = __builtin_shufflevector(low, high, 1, 3, 5, 7, 9, 11, 13, 15);
    }
    z = of([&](int lane) { return base[offsets[lane] + 2]; });
  }

  /// Adds lane l of (x, y, z) to the three numbers at base + offsets[l], for the first n_active lanes l. Several lanes
  /// may have the same offset.
  [[gnu::always_inline]] static void add_triples(const Lanes& x, const Lanes& y, const Lanes& z, int n_active,
                                                 double* base, const unsigned int* offsets) {
    double xyz[3][n_lanes];
    std::memcpy(xyz[0], &x, sizeof x);
    std::memcpy(xyz[1], &y, sizeof y);
    std::memcpy(xyz[2], &z, sizeof z);
    for (int lane = 0; lane < n_active; ++lane) {
      double* triple = base + offsets[lane];
      Native2 xy;
      std::memcpy(&xy, triple, sizeof xy);
      xy += Native2{xyz[0][lane], xyz[1][lane]};
      std::memcpy(triple, &xy, sizeof xy);
      triple[2] += xyz[2][lane];
    }
  }

  /// Returns 1/√x with 11 or more correct bits.
  static Native inverse_sqrt_guess(Native x) {
#if defined(__AVX512F__)
    // The mask has all lanes. Without a mask gcc 12 warns that the function reads an undefined vector.
    if constexpr (n_lanes == 8) return _mm512_maskz_rsqrt14_pd(0xff, x);
#endif
#if defined(__AVX__)
    if constexpr (n_lanes == 4) return _mm256_cvtps_pd(_mm_rsqrt_ps(_mm256_cvtpd_ps(x)));
#endif
#if defined(__x86_64__)
    if constexpr (n_lanes == 2) return _mm_cvtps_pd(_mm_rsqrt_ps(_mm_cvtpd_ps(x)));
#endif
    return Lanes::of([&](int lane) { return 1 / std::sqrt(x[lane]); }).v;
  }

  /// Returns the least number in the first n_active lanes, or NaN if one of them is NaN.
  double least(int n_active) const {
    double m = std::numeric_limits<double>::infinity();
    for (int l = 0; l < n_active; ++l) m = lesser(v[l], m);
    return m;
  }
  /// Returns the sum of the first n_active lanes.
  double sum(int n_active) const {
    double s = 0;
    for (int l = 0; l < n_active; ++l) s += v[l];
    return s;
  }
};

}  // namespace PSEUDORIGID_LANES_OF
}  // namespace pseudorigid::mechanics

#undef PSEUDORIGID_NATIVE_LANES
#undef PSEUDORIGID_LANES_OF
