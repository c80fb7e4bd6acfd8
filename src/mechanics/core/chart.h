#pragma once
/// A chart of a Riemannian manifold Q (Oliva, Geometric Mechanics, 5.1) with coordinates q ∈ ℝⁿ and the metric g_ij(q).
/// The system has a potential U, an external force F_ext and a dissipation D. With ∂_i = ∂/∂q_i, the inverse metric
/// gᵏˡ, and sums over repeated indices,
///
///   Γ_l,ij = ½ (∂_i g_jl + ∂_j g_il − ∂_l g_ij),   Γᵏ_ij = gᵏˡ Γ_l,ij,
///   (Dq̇/dt)ᵏ = q̈ᵏ + Γᵏ_ij q̇ⁱq̇ʲ                                                                     (5.3)
///   μ(v)_i = g_ij vʲ                                                                               (5.4)
///   K = ½ g_ij q̇ⁱq̇ʲ,   F = −dU + F_ext(t, q, q̇) + μ D(q̇)                                           (5.5), (5.122)
///
/// with the Christoffel symbols Γ, the mass operator μ, the kinetic energy K and the sum F of all forces. D/dt is the
/// covariant derivative along a curve. Automatic differentiation gives the derivatives of g and of U.

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <concepts>
#include <type_traits>

#include "mechanics/core/automatic_differentiation.h"
#include "mechanics/core/small_cholesky.h"
#include "mechanics/core/status.h"

namespace pseudorigid::mechanics {

/// A chart has a constant `dimension`, which is n, and a function `metric(q)`, which returns the matrix g_ij(q).
/// `metric` is a template over the scalar type of q, because automatic differentiation calls it with dual numbers.
template <class C>
concept Chart = requires(const C chart, const Coordinates<double, C::dimension> q,
                         const Coordinates<Dual<double, C::dimension>, C::dimension> x) {
  { chart.metric(q) } -> std::convertible_to<Eigen::Matrix<double, C::dimension, C::dimension>>;
  { chart.metric(x) } -> std::convertible_to<Eigen::Matrix<Dual<double, C::dimension>, C::dimension, C::dimension>>;
};

template <class C>
using ChartVector = Coordinates<double, C::dimension>;
template <class C>
using ChartMatrix = Eigen::Matrix<double, C::dimension, C::dimension>;

// Optional functions of a chart. A missing function counts as a function with the value zero.
template <class C>
concept HasPotential = requires(const C chart, const ChartVector<C> q) {
  chart.potential(q);
};  // potential(q) returns U(q); `potential` is a template over the scalar type of q
template <class C>
concept HasDissipation = requires(const C chart, const ChartVector<C> q) {
  chart.dissipation(q, q);
};  // dissipation(q, v) returns the vector D(v) at q, with ⟨D(v), v⟩ < 0 for v ≠ 0
template <class C>
concept HasExternalForce = requires(const C chart, const ChartVector<C> q) {
  chart.external_force(0.0, q, q);
};  // external_force(t, q, v) returns the covector F_ext
template <class C>
concept HasPeriods = requires(const C chart) {
  chart.periods();
};  // periods() returns the period of each coordinate, or 0 if the coordinate is not periodic

/// The metric and its partial derivatives dg[k] = ∂g/∂q_k. The scalar T is double, or a vector of lanes that holds one
/// number for each of several points (lanes.h).
template <Chart C, class T = double>
struct MetricJet {
  Eigen::Matrix<T, C::dimension, C::dimension> g;
  std::array<Eigen::Matrix<T, C::dimension, C::dimension>, C::dimension> dg;
};

/// Returns the metric and its derivatives at q, by automatic differentiation.
template <class T = double, Chart C>
MetricJet<C, T> metric_jet(const C& chart, const std::type_identity_t<Coordinates<T, C::dimension>>& q) {
  constexpr int n = C::dimension;
  const Eigen::Matrix<Dual<T, n>, n, n> g = chart.metric(independent(q));
  MetricJet<C, T> jet;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      jet.g(i, j) = g(i, j).value();
      for (int k = 0; k < n; ++k) jet.dg[k](i, j) = g(i, j).derivatives()[k];
    }
  return jet;
}

/// Returns Σ_ij Γ_l,ij uⁱvʲ for each l, from the metric and its derivatives in `jet`.
template <Chart C, class T>
Coordinates<T, C::dimension> christoffel_of_first_kind(const MetricJet<C, T>& jet,
                                                       const std::type_identity_t<Coordinates<T, C::dimension>>& u,
                                                       const std::type_identity_t<Coordinates<T, C::dimension>>& v) {
  using Vector = Coordinates<T, C::dimension>;
  Vector c = Vector::Constant(T(0.0));
  for (int k = 0; k < C::dimension; ++k) {
    const Vector both = u[k] * v + v[k] * u;
    c += T(0.5) * (jet.dg[k] * both);
    c[k] -= T(0.5) * u.dot(jet.dg[k] * v);
  }
  return c;
}

/// Returns the differential dU at q, or zero if the chart has no potential.
template <class T = double, Chart C>
Coordinates<T, C::dimension> potential_differential(const C& chart,
                                                    const std::type_identity_t<Coordinates<T, C::dimension>>& q) {
  if constexpr (HasPotential<C>) {
    const Dual<T, C::dimension> U = chart.potential(independent(q));
    return U.derivatives();
  }
  return Coordinates<T, C::dimension>::Constant(T(0.0));
}

template <Chart C>
double potential_energy(const C& chart, const ChartVector<C>& q) {
  if constexpr (HasPotential<C>) return chart.potential(q);
  return 0;
}

template <Chart C>
double kinetic_energy(const C& chart, const ChartVector<C>& q, const ChartVector<C>& v) {
  return 0.5 * v.dot(chart.metric(q) * v);
}

/// Returns the mechanical energy E_m = K + U, with U = 0 if the chart has no potential.
template <Chart C>
double mechanical_energy(const C& chart, const ChartVector<C>& q, const ChartVector<C>& v) {
  return kinetic_energy(chart, q, v) + potential_energy(chart, q);
}

/// Returns the covector μ(v) at q, with the components g_ij vʲ.
template <Chart C>
ChartVector<C> apply_mass(const C& chart, const ChartVector<C>& q, const ChartVector<C>& v) {
  return chart.metric(q) * v;
}

/// Sets v = μ⁻¹(p) for the metric g and the covector p; p and v may be the same vector. Fails if p is not finite, or if
/// g is not positive definite up to round-off. For example, the metric of spherical coordinates is singular at the
/// poles.
template <int n>
Status apply_inverse_mass(const Eigen::Matrix<double, n, n>& g, const Eigen::Matrix<double, n, 1>& p,
                          Eigen::Matrix<double, n, 1>& v) {
  const SmallCholesky<n> factor(g);
  bool finite = true;
  for (int i = 0; i < n; ++i) finite = finite && std::isfinite(p[i]);
  if (!factor.regular() || !finite)
    return Status::failure(factor.regular() ? "the force on the chart is not finite"
                                            : "the metric of the chart is singular or not positive");
  v = factor.solve(p);
  return {};
}

/// Sets the Christoffel symbols Gamma[k](i, j) = Γᵏ_ij at q. Fails if the metric is not positive definite, or if a
/// derivative is not finite.
template <Chart C>
Status christoffel_symbols(const C& chart, const ChartVector<C>& q, std::array<ChartMatrix<C>, C::dimension>& Gamma) {
  const MetricJet<C> jet = metric_jet(chart, q);
  for (int i = 0; i < C::dimension; ++i)
    for (int j = 0; j < C::dimension; ++j) {
      const ChartVector<C> e_i = ChartVector<C>::Unit(i), e_j = ChartVector<C>::Unit(j);
      ChartVector<C> column = christoffel_of_first_kind(jet, e_i, e_j);
      if (Status status = apply_inverse_mass(jet.g, column, column); !status) return status;
      for (int k = 0; k < C::dimension; ++k) Gamma[k](i, j) = column[k];
    }
  return {};
}

}  // namespace pseudorigid::mechanics
