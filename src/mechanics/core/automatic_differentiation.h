#pragma once
/// Forward automatic differentiation with Eigen's AutoDiffScalar. One evaluation of a function of n variables gives its
/// value and its n partial derivatives, exact to round-off. The function must accept any scalar type. Nested scalars
/// give second derivatives.
///
/// Eigen's type is used because all n variables have one scalar type. A function whose values are matrices, such as the
/// metric of a chart, then returns an ordinary matrix. In Boost.Math's autodiff each variable has a different type.
///
/// Arithmetic on these scalars returns expressions that refer to their operands. A function must therefore declare the
/// scalar itself as its return type (T, not auto).

#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>

namespace pseudorigid::mechanics {

template <class T, int n>
using Coordinates = Eigen::Matrix<T, n, 1>;

/// A number of type T with its n partial derivatives, which also have the type T.
template <class T, int n>
using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<T, n, 1>>;

/// Returns the coordinates q as independent variables, with the derivatives ∂q_k/∂q_j = δ_kj.
template <class T, int n>
Coordinates<Dual<T, n>, n> independent(const Coordinates<T, n>& q) {
  Coordinates<Dual<T, n>, n> x;
  for (int k = 0; k < n; ++k) {
    x[k].value() = q[k];
    for (int j = 0; j < n; ++j) x[k].derivatives()[j] = T(j == k ? 1.0 : 0.0);
  }
  return x;
}

/// Value, gradient ∂f/∂q_i and Hessian ∂²f/∂q_i∂q_j of a scalar function f at a point.
template <int n>
struct SecondOrderJet {
  double value;
  Coordinates<double, n> gradient;
  Eigen::Matrix<double, n, n> hessian;
};

/// Returns value, gradient and Hessian of f at q. The function f must be a template over the scalar type, because it is
/// called with nested dual numbers.
template <int n, class Function>
SecondOrderJet<n> second_order_jet(const Function& f, const Coordinates<double, n>& q) {
  const auto y = f(independent(independent(q)));
  SecondOrderJet<n> jet;
  jet.value = y.value().value();
  jet.gradient = y.value().derivatives();
  for (int i = 0; i < n; ++i) jet.hessian.row(i) = y.derivatives()[i].derivatives().transpose();
  return jet;
}

}  // namespace pseudorigid::mechanics
