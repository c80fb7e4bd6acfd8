#pragma once
/// The real solid harmonics r^l Y_lm with their gradients. The functions Y_lm are orthonormal on the unit sphere, and
/// are proportional to cos mφ (m ≥ 0) or sin |m|φ (m < 0). They are computed by recurrences in Cartesian coordinates,
/// which have no singularities at the poles or the centre.

#include <array>
#include <vector>

namespace pseudorigid::mechanics {

/// A value and its gradient with respect to the position (x, y, z). The operators + and * compute the value and the
/// gradient of a sum or a product.
struct Jet {
  double value = 0;
  std::array<double, 3> gradient{};
};

inline Jet operator+(const Jet& a, const Jet& b) {
  Jet sum{a.value + b.value, {}};
  for (int i = 0; i < 3; ++i) sum.gradient[i] = a.gradient[i] + b.gradient[i];
  return sum;
}
inline Jet operator*(const Jet& a, const Jet& b) {
  Jet product{a.value * b.value, {}};
  for (int i = 0; i < 3; ++i) product.gradient[i] = a.gradient[i] * b.value + a.value * b.gradient[i];
  return product;
}
inline Jet operator*(double s, const Jet& a) { return Jet{s, {}} * a; }
inline Jet constant(double value) { return {value, {}}; }

/// Returns for each coordinate x, y, z if Y_lm is odd in this coordinate (true) or even (false).
inline std::array<bool, 3> is_odd(int l, int m) {
  const int order = m < 0 ? -m : m;
  return {(order % 2 == 1) != (m < 0), m < 0, (l - order) % 2 == 1};
}

/// Returns the functions r^l Y_lm with their gradients at the position x, with r = |x|. The function of degree l ≤ N
/// and order m is at [l][l + m].
std::vector<std::vector<Jet>> solid_harmonics(int N, const std::array<double, 3>& x);

}  // namespace pseudorigid::mechanics
