#pragma once
/// Maxwell branches of a viscoelastic body. A branch is a spring of shear modulus μ_b in series with a dashpot. The
/// relaxation time of the branch is τ_b. All branches are parallel to the elastic law. The internal metric C_i
/// describes the strain of the dashpot. It is symmetric and positive definite, with det C_i = 1. The symbols are
/// F = ∂x/∂X, J = det F, C = FᵀF and the isochoric strain Ĉ = J^{−2/3} C. A branch has the stored energy W_b per
/// reference volume, the first Piola–Kirchhoff stress P_b and the flow Ċ_i:
///
///   W_b = (μ_b/2)(tr(Ĉ C_i⁻¹) − 3),
///   P_b = ∂W_b/∂F = μ_b J^{−2/3} (F C_i⁻¹ − ⅓ tr(C C_i⁻¹) F⁻ᵀ),
///   Ċ_i = (1/τ_b)(Ĉ − ⅓ tr(Ĉ C_i⁻¹) C_i).
///
/// This is the finite viscoelasticity of Simo (1987) and Reese and Govindjee (1998) for one neo-Hookean spring. The
/// branch dissipates the power (μ_b/(2τ_b))(tr (Ĉ C_i⁻¹)² − ⅓ tr²(Ĉ C_i⁻¹)) ≥ 0 per reference volume. For small
/// strains, the strain ε_i of the dashpot and the deviatoric strain ε of the body satisfy ε̇_i = (ε − ε_i)/τ_b.
///
/// For constant Ĉ the flow has an exact solution C_i(t). Up to the factor 1/D, C_i(t) is on the straight line from
/// C_i(0) to Ĉ. The share w of Ĉ on this line increases from 0 to 1. The numbers α and β belong to C_i(0):
///
///   C_i(t) = Y/D,   Y = (1 − w) C_i(0) + w Ĉ,   D³ = det Y = 1 + w(1 − w)[α(1 − w) + βw],
///   α = tr(Ĉ C_i(0)⁻¹) − 3,   β = tr(Ĉ⁻¹C_i(0)) − 3,
///   s − I(w) = t/τ_b,   w = 1 − e^{−s},   I(w) = ∫₀^w w'[α(1 − w') + βw']/(D + D² + D³) dw'.
///
/// The equation for s follows from ẇ = (1 − w) D/τ_b, which results if Y/D is inserted into the flow. Until the time t,
/// the branch loses the following energy per reference volume:
///
///   (μ_b/2)[(α + 3)(D² − 1) + w(α(2 − w) − 2β(1 − w))]/D².
///
/// The functions are templates for doubles and for SIMD vectors (mechanics/core/lanes.h) with one material point in
/// each lane.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "materials/tensor.h"
#include "mechanics/core/lanes.h"

namespace pseudorigid::materials {

struct MaxwellBranch {
  double modulus = 0;          ///< shear modulus μ_b
  double relaxation_time = 1;  ///< relaxation time τ_b
  bool operator==(const MaxwellBranch&) const = default;
};
using MaxwellBranches = std::vector<MaxwellBranch>;
inline constexpr std::size_t most_branches = 4;  ///< largest number of branches of a body
/// One energy for each branch, in the order of the branches. The entries of branches that a body does not have are 0.
using BranchEnergies = std::array<double, most_branches>;

/// A symmetric 3×3 matrix, stored as the entries 00, 01, 02, 11, 12, 22.
template <class T>
struct Symmetric {
  static constexpr int n_entries = 6;
  T a[n_entries];
};

/// The internal metric C_i = Id of a dashpot without strain.
inline constexpr Symmetric<double> identity_metric{{1, 0, 0, 1, 0, 1}};

/// Returns A + s B.
template <class T>
[[gnu::always_inline]] inline Symmetric<T> plus(const Symmetric<T>& A, const T& s, const Symmetric<T>& B) {
  return {{A.a[0] + s * B.a[0], A.a[1] + s * B.a[1], A.a[2] + s * B.a[2], A.a[3] + s * B.a[3], A.a[4] + s * B.a[4],
           A.a[5] + s * B.a[5]}};
}
template <class T>
[[gnu::always_inline]] inline Symmetric<T> operator*(const T& s, const Symmetric<T>& A) {
  return {{s * A.a[0], s * A.a[1], s * A.a[2], s * A.a[3], s * A.a[4], s * A.a[5]}};
}
/// Returns the adjugate of A, which is the inverse if det A = 1.
template <class T>
[[gnu::always_inline]] inline Symmetric<T> adjugate(const Symmetric<T>& A) {
  const T *m = A.a, &a = m[0], &b = m[1], &c = m[2], &d = m[3], &e = m[4], &f = m[5];
  return {{d * f - e * e, c * e - b * f, b * e - c * d, a * f - c * c, b * c - a * e, a * d - b * b}};
}
template <class T>
[[gnu::always_inline]] inline T determinant(const Symmetric<T>& A, const Symmetric<T>& adjugate) {
  return A.a[0] * adjugate.a[0] + A.a[1] * adjugate.a[1] + A.a[2] * adjugate.a[2];
}
/// Returns A : B = tr(AB).
template <class T>
[[gnu::always_inline]] inline T dot(const Symmetric<T>& A, const Symmetric<T>& B) {
  return (A.a[0] * B.a[0] + A.a[3] * B.a[3] + A.a[5] * B.a[5]) +
         2.0 * (A.a[1] * B.a[1] + A.a[2] * B.a[2] + A.a[4] * B.a[4]);
}
/// Returns FᵀF.
template <class T>
[[gnu::always_inline]] inline Symmetric<T> gram(const Tensor<T>& F) {
  const auto entry = [&](int i, int j) { return F(0, i) * F(0, j) + F(1, i) * F(1, j) + F(2, i) * F(2, j); };
  return {{entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)}};
}

namespace detail {

/// Returns the vector with f(x_l, l) in lane l, where x_l is lane l of x. If x is a double, returns f(x, 0).
template <int n, class Function>
mechanics::Lanes<n> in_each_lane(const mechanics::Lanes<n>& x, const Function& f) {
  return mechanics::Lanes<n>::of([&](int l) { return f(x[l], l); });
}
template <class Function>
double in_each_lane(double x, const Function& f) {
  return f(x, 0);
}
template <int n>
double lane(const mechanics::Lanes<n>& x, int l) {
  return x[l];
}
inline double lane(double x, int) { return x; }

/// Returns true if |x| ≤ bound in all lanes. Returns false if a lane is NaN.
template <int n>
bool all_within(const mechanics::Lanes<n>& x, double bound) {
  bool all = true;
  for (int l = 0; l < n; ++l) all = all && std::abs(x[l]) <= bound;
  return all;
}
inline bool all_within(double x, double bound) { return std::abs(x) <= bound; }

/// Largest |p| for which cube_root_near_one(p) is accurate.
inline constexpr double near_one = 0.1;
/// Returns (1 + p)^{1/3}, by one step of Halley's method from the first four terms of the power series in p. The error
/// is below 1e-16 if |p| is at most `near_one`.
template <class T>
[[gnu::always_inline]] inline T cube_root_near_one(const T& p) {
  const T y = 1.0 + p * (1.0 / 3 + p * ((5.0 / 81) * p - 1.0 / 9)), y3 = y * y * y, u = 1.0 + p;
  return y * (y3 + 2.0 * u) / (2.0 * y3 + u);
}
/// Returns the cube root of u. If |u − 1| is larger than `near_one` in any lane, std::cbrt computes the roots of all
/// lanes.
template <class T>
T cube_root(const T& u) {
  const T p = u - 1.0;
  return all_within(p, near_one) ? cube_root_near_one(p) : in_each_lane(u, [](double x, int) { return std::cbrt(x); });
}

/// A Gauss rule with n points on the interval (0, 1).
template <std::size_t n>
struct GaussRule {
  std::array<double, n> points, weights;
};
inline constexpr GaussRule<4> four_points{
    {0.069431844202973712, 0.33000947820757187, 0.66999052179242813, 0.93056815579702629},
    {0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693}};
inline constexpr GaussRule<8> eight_points{
    {0.019855071751231884, 0.10166676129318664, 0.23723379504183550, 0.40828267875217510, 0.59171732124782490,
     0.76276620495816450, 0.89833323870681336, 0.98014492824876812},
    {0.050614268145188130, 0.11119051722668724, 0.15685332293894364, 0.18134189168918099, 0.18134189168918099,
     0.15685332293894364, 0.11119051722668724, 0.050614268145188130}};

/// Returns an upper bound of λ − 1 for the eigenvalues λ > 1 of a matrix. The matrix is Ĉ C_i⁻¹ if `excess` is α, and
/// its inverse if `excess` is β. With λ = e^h the bound follows from h²/2 ≤ e^h − 1 − h ≤ `excess`. The bound is needed
/// because the integrand of I(w) has singularities where D = 0. Their distances from [0, 1] are 1/(λ − 1): below 0 for
/// Ĉ C_i⁻¹, and above 1 for its inverse.
inline double largest_stretch(double excess) {
  const double positive = std::max(excess, 0.0);
  return positive + std::sqrt(2 * positive);
}

/// Computes w at the time t = xτ_b, for any α and β. Negative α and β result from round-off and are replaced by 0. The
/// function `share(x)` returns w. It solves s − I(w) = x for s by Newton's method, with a bisection if an iterate
/// leaves the interval that contains s.
class FlowLine {
 public:
  FlowLine(double alpha, double beta) : alpha_(std::max(alpha, 0.0)), beta_(std::max(beta, 0.0)) {}

  double share(double x) const {
    double low = x, high = x + alpha_ / 18 + beta_ / 9, s = low;  // because 0 ≤ I ≤ α/18 + β/9 from D ≥ 1
    constexpr int most_iterations = 100;
    for (int i = 0; i < most_iterations; ++i) {
      const double w = -std::expm1(-s), residual = s - integral(w) - x;
      (residual < 0 ? low : high) = s;
      double next = s - residual * D(w);
      if (!(next >= low && next <= high)) next = 0.5 * (low + high);
      if (std::abs(next - s) <= 4e-16 * s) break;
      s = next;
    }
    return -std::expm1(-s);
  }

 private:
  double excess(double w) const { return w * (alpha_ * (1 - w) + beta_ * w); }  // (D³ − 1)/(1 − w)
  double D(double w) const { return std::cbrt(1 + (1 - w) * excess(w)); }

  /// Returns I(w), by Gauss quadrature over panels that are shorter near 0 and near 1.
  double integral(double w) const {
    const double at_0 = 1 / largest_stretch(alpha_), at_1 = 1 / largest_stretch(beta_);
    double sum = 0;
    for (double p = 0; p < w;) {
      const double longest = std::min(0.5 * (p + at_0), (1 - p + at_1) / 3), length = std::min(longest, w - p);
      for (std::size_t k = 0; k < eight_points.points.size(); ++k) {
        const double at = p + length * eight_points.points[k], d = D(at);
        sum += length * eight_points.weights[k] * excess(at) / (d * (1 + d + d * d));
      }
      p = length < longest ? w : p + length;
    }
    return sum;
  }

  double alpha_, beta_;
};

/// Computes w at the time t = xτ_b, for all lanes of α and β together. The result is accurate if the Gauss rule on one
/// panel [0, w] is sufficient for I(w), and if D is near 1. Call `one_panel` before `share`: it checks these
/// conditions.
template <class T>
class ShortFlow {
 public:
  ShortFlow(const T& alpha, const T& beta, double x) : alpha_(alpha), beta_(beta), x_(x) {}

  /// Returns true if α and β are finite and `share` is accurate to round-off in all lanes. Also chooses the number of
  /// Gauss points, 4 or 8. The check uses the bound w ≤ x(α + 3)/3.
  bool one_panel() {
    double worst = 0, largest = 0;
    bool all_numbers = true;
    in_each_lane(alpha_, [&](double alpha, int l) {
      const double excess = std::max(alpha, lane(beta_, l)), most = std::min(1.0, x_ * (alpha + 3) / 3);
      all_numbers = all_numbers && std::isfinite(excess);
      worst = std::max(worst, most * largest_stretch(excess));
      largest = std::max(largest, excess * std::min(0.25, most));
      return 0.0;
    });
    few_points_ = worst <= 0.1;
    return all_numbers && worst <= 0.5 && largest <= near_one;
  }

  /// Returns w, by two steps of Newton's method for s. The start is s = x + I(1 − e^{−x}) with D = 1 in I.
  T share() const {
    const double w0 = -std::expm1(-x_);
    T s = x_ + (w0 * w0 / 6) * alpha_ + (w0 * w0 * w0 / 9) * (beta_ - alpha_);
    T w = share_of(s);
    for (int i = 0; i < 2; ++i) {
      const T sum = few_points_ ? mean(four_points, w) : mean(eight_points, w);
      const T D = cube_root_near_one((1.0 - w) * excess(w));
      s = s - D * (s - w * sum - x_);
      w = share_of(s);
    }
    return w;
  }

 private:
  T excess(const T& w) const { return w * (alpha_ + w * (beta_ - alpha_)); }

  /// Returns the mean of the integrand of I over [0, w], which is I(w)/w.
  template <std::size_t n>
  T mean(const GaussRule<n>& rule, const T& w) const {
    T sum(0.0);
    for (std::size_t k = 0; k < n; ++k) {
      const T at = rule.points[k] * w, e = excess(at), D = cube_root_near_one((1.0 - at) * e);
      sum += rule.weights[k] * e / (D * (1.0 + D * (1.0 + D)));
    }
    return sum;
  }

  /// Returns w = 1 − e^{−s}, by the series for s/2ⁿ and n doublings 1 − e^{−2s} = w(2 − w).
  T share_of(const T& s) const {
    const int n = x_ <= 0.08 ? 0 : static_cast<int>(std::ceil(std::log2(x_ / 0.08)));
    const T small = std::ldexp(1.0, -n) * s;
    T series(1.0 / 362880);
    for (const double factorial : {40320.0, 5040.0, 720.0, 120.0, 24.0, 6.0, 2.0, 1.0})
      series = 1 / factorial - small * series;
    T w = small * series;
    for (int i = 0; i < n; ++i) w = w * (2.0 - w);
    return w;
  }

  T alpha_, beta_;
  double x_;
  bool few_points_ = false;
};

/// Returns w at the time t = xτ_b ≥ 0. If ShortFlow is not accurate in some lane, FlowLine computes w in every lane.
template <class T>
T share_of_flow(const T& alpha, const T& beta, double x) {
  constexpr double forever = 60;  // 1 − e^{−60} is 1 in double precision
  ShortFlow<T> flow(alpha, beta, std::min(x, forever));
  if (flow.one_panel()) return flow.share();
  return in_each_lane(alpha, [&](double of_lane, int l) { return FlowLine(of_lane, lane(beta, l)).share(x); });
}

}  // namespace detail

/// Returns C/(det C)^{1/3}, which has the determinant 1.
template <class T>
Symmetric<T> unimodular(const Symmetric<T>& C) {
  return (1.0 / detail::cube_root(determinant(C, adjugate(C)))) * C;
}
/// Returns Ĉ = (det F)^{−2/3} FᵀF.
template <class T>
Symmetric<T> isochoric_strain(const Tensor<T>& F) {
  return unimodular(gram(F));
}
/// Returns C/(det C)^{1/3} for the mean C = ½(F0ᵀF0 + F1ᵀF1). F0 and F1 are the deformation gradients at the beginning
/// and the end of a time step. The mean C does not change if F0 and F1 are multiplied from the left by different
/// rotations. The isochoric strain of ½(F0 + F1) would change.
template <class T>
Symmetric<T> mean_strain(const Tensor<T>& F0, const Tensor<T>& F1) {
  return unimodular(plus(gram(F0), T(1.0), gram(F1)));
}

/// Replaces C_i(0) = `metric` by C_i(t) for constant Ĉ = `strain`, with x = t/τ_b ≥ 0. Both matrices must have the
/// determinant 1. Returns the energy that the branch loses per reference volume, divided by μ_b.
template <class T>
T relax(const Symmetric<T>& strain, double x, Symmetric<T>& metric) {
  const T alpha = dot(adjugate(metric), strain) - 3.0, beta = dot(adjugate(strain), metric) - 3.0;
  const T w = detail::share_of_flow(alpha, beta, x);
  const Symmetric<T> Y = plus((1.0 - w) * metric, w, strain);
  const T D = detail::cube_root(determinant(Y, adjugate(Y))), D2 = D * D;
  metric = (1.0 / D) * Y;
  const T v = 1.0 - w, D2_minus_1 = v * w * (alpha * v + beta * w) * (D + 1.0) / (1.0 + D + D2);
  return 0.5 * ((alpha + 3.0) * D2_minus_1 + w * (alpha * (1.0 + v) - 2.0 * beta * v)) / D2;
}

/// Adds μ_b C_i⁻¹ of one branch to the sum A over the branches, with μ_b = `modulus` and C_i = `metric`.
template <class T>
[[gnu::always_inline]] inline void add_branch(double modulus, const Symmetric<T>& metric, Symmetric<T>& A) {
  A = plus(A, T(modulus), adjugate(metric));
}

/// Returns the first Piola–Kirchhoff stress Σ P_b of all branches for A = Σ μ_b C_i⁻¹.
template <class T>
Tensor<T> stress_of_branches(const Tensor<T>& F, const Symmetric<T>& A) {
  const Tensor<T> cof = cofactor(F);
  const T J = determinant(F, cof), root = detail::cube_root(J), factor = 1.0 / (root * root);
  const T of_cofactor = (-1.0 / 3) * factor * dot(gram(F), A) / J;
  const T* m = A.a;
  const auto entry = [&](int i, const T& a, const T& b, const T& c, int j) {
    return factor * (F(i, 0) * a + F(i, 1) * b + F(i, 2) * c) + of_cofactor * cof(i, j);
  };
  Tensor<T> P;
  for (int i = 0; i < 3; ++i) {
    P(i, 0) = entry(i, m[0], m[1], m[2], 0);
    P(i, 1) = entry(i, m[1], m[3], m[4], 1);
    P(i, 2) = entry(i, m[2], m[4], m[5], 2);
  }
  return P;
}

/// Returns the energy Σ W_b = ½ (Ĉ:A − 3 Σ μ_b) per reference volume for A = Σ μ_b C_i⁻¹.
template <class T>
T energy_of_branches(const Tensor<T>& F, const Symmetric<T>& A, double sum_of_moduli) {
  return 0.5 * (dot(isochoric_strain(F), A) - 3.0 * sum_of_moduli);
}

/// The branches at a point, as the stress and the energy need them (point_fields.h). Without branches, both members are
/// zero.
struct BranchesAtPoint {
  Symmetric<double> inverse_sum{};  ///< sum Σ μ_b C_i⁻¹ over the branches
  double sum_of_moduli = 0;
};

inline double sum_of_moduli(const MaxwellBranches& branches) {
  double sum = 0;
  for (const MaxwellBranch& branch : branches) sum += branch.modulus;
  return sum;
}

}  // namespace pseudorigid::materials
