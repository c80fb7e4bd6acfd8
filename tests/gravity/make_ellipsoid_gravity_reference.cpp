/// Writes ellipsoid_gravity_reference.csv: 1000 triples of semi-axes a_i with the exact bits of the doubles, and
///
///   d_i = R_D(a_j², a_k², a_i²) to 50 digits,      t_k = (3/2) ∫₀^∞ ds/((a_i² + s)(a_j² + s)Δ) = −(d_i − d_j)/(a_i² −
///   a_j²) to 30,
///
/// by Boost.Multiprecision and Boost.Math's ellint_rd with 150 digits; where two axes coincide to 50 digits, one is
/// moved by 10⁻⁵⁰ of itself: the quotient then still has 50 right digits.
///
/// make_ellipsoid_gravity_reference > ellipsoid_gravity_reference.csv

#include <array>
#include <boost/math/special_functions/ellint_rd.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <random>
#include <vector>

namespace {

using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<150>, boost::multiprecision::et_off>;
using Axes = std::array<double, 3>;

/// Draws with a fixed seed; std distributions are avoided, as their values differ between libraries.
class Draw {
 public:
  double uniform(double from, double to) { return from + (to - from) * double(bits_() >> 11) * 0x1p-53; }
  double power_of_ten(double from, double to) { return std::pow(10, uniform(from, to)); }
  double sign() { return bits_() >> 63 ? 1 : -1; }

 private:
  std::mt19937_64 bits_{20260101};
};

std::vector<Axes> triples() {
  constexpr size_t n_triples = 1000;
  Draw draw;
  std::vector<Axes> list{{1, 1, 1}};
  for (int k = 1; k <= 6; ++k)  // flat bodies and needles in every order
    for (const double a : {std::pow(10, k), std::pow(10, -k)})
      for (const Axes& axes : {Axes{a, 1, 1}, Axes{1, a, 1}, Axes{1, 1, a}}) list.push_back(axes);
  for (int i = 0; i < 150; ++i)  // nearly spheres
    list.push_back({1, 1 + draw.sign() * draw.power_of_ten(-17, -1), 1 + draw.sign() * draw.power_of_ten(-17, -1)});
  for (int i = 0; i < 150; ++i) {  // spheroids
    const double a = draw.power_of_ten(-1, 1), c = a * draw.power_of_ten(-6, 6);
    list.push_back(i % 3 == 0 ? Axes{a, a, c} : i % 3 == 1 ? Axes{a, c, a} : Axes{c, a, a});
  }
  for (int i = 0; i < 100; ++i) {  // nearly spheroids
    const double a = draw.power_of_ten(-1, 1), c = a * draw.power_of_ten(-3, 3);
    list.push_back({a, a * (1 + draw.power_of_ten(-17, -1)), c});
  }
  for (int i = 0; i < 100; ++i)  // extreme triaxial bodies
    list.push_back({1, draw.power_of_ten(-6, 6), draw.power_of_ten(-6, 6)});
  for (int i = 0; i < 100; ++i) {  // sizes whose squares come near to overflow or underflow
    const double size = draw.power_of_ten(100, 150), a = i % 2 ? size : 1 / size;
    list.push_back({a, a * draw.power_of_ten(-1, 1), a * draw.power_of_ten(-1, 1)});
  }
  while (list.size() < n_triples)  // moderate triaxial bodies
    list.push_back({1, draw.power_of_ten(-2, 2), draw.power_of_ten(-2, 2)});
  return list;
}

std::array<Real, 3> d_of(const std::array<Real, 3>& x) {
  using boost::math::ellint_rd;
  return {ellint_rd(x[1], x[2], x[0]), ellint_rd(x[2], x[0], x[1]), ellint_rd(x[0], x[1], x[2])};
}

Real t_of(std::array<Real, 3> x, int k) {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  if (abs(x[i] - x[j]) < Real("1e-50") * x[i]) x[j] = x[i] * (1 + Real("1e-50"));
  const auto d = d_of(x);
  return -(d[i] - d[j]) / (x[i] - x[j]);
}

}  // namespace

int main() {
  std::cout << "a_1,a_2,a_3,d_1,d_2,d_3,t_1,t_2,t_3\n" << std::scientific;
  for (const Axes& a : triples()) {
    std::array<Real, 3> x;
    for (int i = 0; i < 3; ++i) x[i] = Real(a[i]) * a[i];
    const auto d = d_of(x);
    const Real sum = 3 / sqrt(x[0] * x[1] * x[2]);  // Σ d_i in closed form
    if (abs(d[0] + d[1] + d[2] - sum) > Real("1e-60") * sum) return EXIT_FAILURE;
    std::printf("%a,%a,%a", a[0], a[1], a[2]);
    std::fflush(stdout);
    for (const Real& value : d) std::cout << ',' << value.str(50, std::ios::scientific);
    for (int k = 0; k < 3; ++k) std::cout << ',' << t_of(x, k).str(30, std::ios::scientific);
    std::cout << std::endl;
  }
}
