#pragma once
/// Operations that methods apply to vectors of any type. Every vector can be copied and has the operations y ← y + a x,
/// x ← a x and |x|_∞. Estimates of frequencies also use the scalar product xᵀy. Iterative solvers also use sums of
/// several vectors, and several scalar products with one sum over the processes. For distributed vectors VectorSpace
/// has a specialisation, and all processes must call max_norm, dot and dots together.
///
/// The operation `add` is for a long sum y of small increments a x. It also stores the round-off c of the sum
/// (compensated summation, Kahan 1965; Hairer, Lubich, Wanner, Geometric Numerical Integration, VIII.5). With t = a x +
/// c and the rounded value fl,
///
///   y ← fl(y + t),   c ← (y_old + t) − y   (exact, by Knuth's two-sum).

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <span>

namespace pseudorigid::mechanics {

template <class V>
struct VectorSpace {  // dense Eigen vectors and matrices
  // `dense` is true if V is an Eigen type with all entries on this process. `compensated` is true if `add` stores the
  // round-off of sums.
  static constexpr bool dense = true, compensated = true;
  static void add(double a, const V& x, V& y, V& c) {
    for (Eigen::Index i = 0; i < y.size(); ++i) {
      const double t = a * x.data()[i] + c.data()[i], y_old = y.data()[i];
      const double sum = y_old + t, t_rounded = sum - y_old;
      c.data()[i] = (y_old - (sum - t_rounded)) + (t - t_rounded);
      y.data()[i] = sum;
    }
  }
  static void axpy(double a, const V& x, V& y) { y.noalias() += a * x; }
  static void scale(double a, V& x) {
    if (a == 0)
      x.setZero();  // also clears numbers that are not finite
    else
      x *= a;
  }
  static double max_norm(const V& x) { return x.size() == 0 ? 0.0 : x.template lpNorm<Eigen::Infinity>(); }
  static double dot(const V& x, const V& y) { return x.cwiseProduct(y).sum(); }
  static void dots(std::span<const V* const> x, const V& y, std::span<double> products) {
    for (std::size_t k = 0; k < x.size(); ++k) products[k] = dot(*x[k], y);
  }
  /// Replaces y by s (y + Σ a_k x_k).
  static void combine(double s, V& y, std::span<const double> a, std::span<const V* const> x) {
    for (std::size_t k = 0; k < x.size(); ++k) y.noalias() += a[k] * *x[k];
    y *= s;
  }
  static std::span<double> local_values(V& x) { return {x.data(), static_cast<std::size_t>(x.size())}; }
};

template <>
struct VectorSpace<double> {  // the multiplier of one constraint
  static void axpy(double a, double x, double& y) { y += a * x; }
  static void scale(double a, double& x) { x *= a; }
  static double max_norm(double x) { return std::abs(x); }
  static std::span<double> local_values(double& x) { return {&x, 1}; }
};

/// The multiplier of a system without constraints, an empty object.
struct NoMultiplier {};

template <>
struct VectorSpace<NoMultiplier> {
  static void axpy(double, NoMultiplier, NoMultiplier&) {}
  static void scale(double, NoMultiplier&) {}
  static double max_norm(NoMultiplier) { return 0; }
  static std::span<double> local_values(NoMultiplier&) { return {}; }
};

template <class V>
void axpy(double a, const V& x, V& y) {
  VectorSpace<V>::axpy(a, x, y);
}
template <class V>
void scale(double a, V& x) {
  VectorSpace<V>::scale(a, x);
}
template <class V>
double max_norm(const V& x) {
  return VectorSpace<V>::max_norm(x);
}
template <class V>
double dot(const V& x, const V& y) {
  return VectorSpace<V>::dot(x, y);
}
/// Adds a x to y. If sums of the type V are compensated, c contains the round-off of y before and after the call. Set c
/// to zero at the start of a sum. If sums are not compensated, c is not used.
template <class V>
void add(double a, const V& x, V& y, V& c) {
  if constexpr (VectorSpace<V>::compensated)
    VectorSpace<V>::add(a, x, y, c);
  else
    axpy(a, x, y);
}
/// Returns the entries of x that this process owns, column by column for a matrix. Changes of the span change x.
template <class V>
std::span<double> local_values(V& x) {
  return VectorSpace<V>::local_values(x);
}

}  // namespace pseudorigid::mechanics
