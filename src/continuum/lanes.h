#pragma once
/// A SIMD vector of doubles, one lane a cell, on the compiler's vector extension: the packaged deal.II has no wide
/// vectors, and with a deal.II that has them nothing changes here.

#include <cstring>
#include <limits>

namespace pseudorigid::continuum {

/// Lanes of the widest vector that this translation unit may use.
#if defined(__AVX512F__)
inline constexpr int native_lanes = 8;
#elif defined(__AVX__)
inline constexpr int native_lanes = 4;
#else
inline constexpr int native_lanes = 2;
#endif

/// The lesser of two numbers, a NaN being the least of all.
inline double lesser(double a, double b) { return a < b || a != a ? a : b; }

namespace detail {
template <int n_lanes>
struct VectorTypes;  // spelled out, since the compiler ignores a vector size that depends on a template parameter
template <>
struct VectorTypes<2> {
  typedef double Real __attribute__((vector_size(16)));
  typedef long long Integer __attribute__((vector_size(16)));
};
template <>
struct VectorTypes<4> {
  typedef double Real __attribute__((vector_size(32)));
  typedef long long Integer __attribute__((vector_size(32)));
};
template <>
struct VectorTypes<8> {
  typedef double Real __attribute__((vector_size(64)));
  typedef long long Integer __attribute__((vector_size(64)));
};
}  // namespace detail

template <int n_lanes>
struct Lanes {
  using Native = typename detail::VectorTypes<n_lanes>::Real;
  using NativeInt = typename detail::VectorTypes<n_lanes>::Integer;
  Native v;

  Lanes() = default;
  Lanes(Native native) : v(native) {}
  Lanes(double s) : v(Native{} + s) {}

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
  /// The lesser lane by lane, a NaN being the least of all.
  friend Lanes min(Lanes a, Lanes b) { return (a.v < b.v) | (a.v != a.v) ? a.v : b.v; }

  /// Natural logarithm of positive finite numbers, to about one unit in the last place:
  /// x = 2^e m, m in [√½, √2), z = (m−1)/(m+1), ln x = e ln 2 + 2(z + z³/3 + z⁵/5 + …).
  friend Lanes log(Lanes x) {
    NativeInt bits;
    std::memcpy(&bits, &x.v, sizeof bits);
    constexpr long long sqrt_half_bits = 0x3fe6a09e667f3bcdLL, mantissa_mask = 0x000fffffffffffffLL;
    const NativeInt exponent = (bits - sqrt_half_bits) >> 52;
    const NativeInt mantissa_bits = ((bits - sqrt_half_bits) & mantissa_mask) + sqrt_half_bits;
    Native m;
    std::memcpy(&m, &mantissa_bits, sizeof m);
    const Native z = (m - 1.0) / (m + 1.0), z2 = z * z;
    Native series = Native{} + 1.0 / 23;
    for (int i = 21; i >= 3; i -= 2) series = series * z2 + 1.0 / i;
    const Native e = __builtin_convertvector(exponent, Native);
    return (2 * z + 2 * z * z2 * series) + e * 0.69314718055994530942;
  }

  /// ln(1 + x) without loss for small x: the rounding error of 1 + x is put back to first order.
  friend Lanes log1p(Lanes x) {
    const Native u = 1.0 + x.v;
    return log(Lanes(u)).v - ((u - 1.0) - x.v) / u;
  }

  double least(int n_active) const {
    double m = std::numeric_limits<double>::infinity();
    for (int l = 0; l < n_active; ++l) m = lesser(v[l], m);
    return m;
  }
  double sum(int n_active) const {
    double s = 0;
    for (int l = 0; l < n_active; ++l) s += v[l];
    return s;
  }
};

}  // namespace pseudorigid::continuum
