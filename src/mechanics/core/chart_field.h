#pragma once
/// The generalized Newton law in intrinsic form (Oliva, Geometric Mechanics, 5.1, 5.3). A chart has the metric g, the
/// Christoffel symbols Γ, the mass operator μ and the force F (chart.h). With the covariant derivative D/dt, the law is
///
///   μ(Dq̇/dt) = F(q̇)                                                                              (5.7)
///   q̈ᵏ = −Γᵏ_ij q̇ⁱq̇ʲ + (μ⁻¹F)ᵏ                                                                    (5.19)
///
/// On TQ, this law is the vector field E = S + C_v(μ⁻¹F), with the geodesic flow S and the vertical lift C_v (5.22).
/// One solve with g gives both terms: Σ_k g_lk q̈ᵏ = F_l − Γ_l,ij q̇ⁱq̇ʲ.

#include <utility>

#include "mechanics/core/chart.h"
#include "mechanics/core/gauss_stages.h"
#include "mechanics/core/second_order_field.h"

namespace pseudorigid::mechanics {

/// Returns F_l − Γ_l,ij vⁱvʲ for each l, at the position q and the velocity v, and sets g to the metric at q. F is here
/// the force without F_ext, so the result does not depend on time. T is the scalar type, for example a vector of lanes
/// (lanes.h).
template <class T, Chart C>
Coordinates<T, C::dimension> covariant_force(const C& chart, const Coordinates<T, C::dimension>& q,
                                             const Coordinates<T, C::dimension>& v,
                                             Eigen::Matrix<T, C::dimension, C::dimension>& g) {
  const MetricJet<C, T> jet = metric_jet<T>(chart, q);
  g = jet.g;
  Coordinates<T, C::dimension> F = -potential_differential<T>(chart, q) - christoffel_of_first_kind(jet, v, v);
  if constexpr (HasDissipation<C>) F += g * chart.dissipation(q, v);
  return F;
}

/// The law of a chart as a SecondOrderField (second_order_field.h). A field contains its own copy of the chart.
template <Chart C>
class ChartField {
 public:
  using Vector = ChartVector<C>;
  struct Workspace {};

  explicit ChartField(C chart) : chart_(std::move(chart)) {}

  /// Sets a = q̈ of the motion through (q, v). Fails if the metric is not positive definite, or if the force or a
  /// derivative of the metric is not finite.
  Status acceleration(double t, const Vector& q, const Vector& v, Workspace&, Vector& a) const {
    const MetricJet<C> jet = metric_jet(chart_, q);
    const Vector rhs = force(t, q, v, jet.g) - christoffel_of_first_kind(jet, v, v);
    return apply_inverse_mass(jet.g, rhs, a);
  }

  /// The next two members solve for the stages of a Gauss step in SIMD lanes, and return the cost of an iteration on
  /// the stages (stage_by_stage.h). They call the free functions `solve_stages_in_lanes_of(chart, stages)` and
  /// `cost_of_iteration_of(chart)`. A member exists if its free function is defined for the type of the chart.
  bool solve_stages_in_lanes(GaussStages& stages) const requires requires(const C& c) {
    solve_stages_in_lanes_of(c, stages);
  }
  { return solve_stages_in_lanes_of(chart_, stages); }
  double cost_of_iteration() const requires requires(const C& c) { cost_of_iteration_of(c); }
  { return cost_of_iteration_of(chart_); }

  /// Sets D to the covariant acceleration q̈ᵏ + Γᵏ_ij vⁱvʲ of a curve through q with the velocity v.
  /// `second_derivative` is q̈ of this curve. Fails if the metric is not positive definite or a derivative of the
  /// metric is not finite.
  Status covariant_acceleration(const Vector& q, const Vector& v, const Vector& second_derivative, Vector& D) const {
    const MetricJet<C> jet = metric_jet(chart_, q);
    if (Status status = apply_inverse_mass(jet.g, christoffel_of_first_kind(jet, v, v), D); !status) return status;
    D += second_derivative;
    return {};
  }

  /// Returns the force F = −dU + F_ext + μ D(v) as a covector. Terms that the chart does not have are zero.
  Vector force(double t, const Vector& q, const Vector& v) const { return force(t, q, v, chart_.metric(q)); }

  double energy(const Vector& q, const Vector& v) const { return mechanical_energy(chart_, q, v); }

  static constexpr bool dissipative() { return HasDissipation<C>; }
  static constexpr bool velocity_dependent() { return HasDissipation<C> || HasExternalForce<C>; }

  const C& chart() const { return chart_; }
  Vector make_vector() const { return Vector::Zero(); }
  Workspace make_workspace() const { return {}; }

 private:
  Vector force(double t, const Vector& q, const Vector& v, const ChartMatrix<C>& g) const {
    Vector F = -potential_differential(chart_, q);
    if constexpr (HasExternalForce<C>) F += chart_.external_force(t, q, v);
    if constexpr (HasDissipation<C>) F += g * chart_.dissipation(q, v);
    return F;
  }

  C chart_;
};

}  // namespace pseudorigid::mechanics
