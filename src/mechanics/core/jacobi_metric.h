#pragma once
/// The Jacobi metric g_h of a conservative system at energy h (Oliva, Geometric Mechanics, 5.2). With the metric g and
/// the potential U of the system, the Jacobi metric is defined on Q_h = {U < h}:
///
///   g_h = 2(h − U) g = e^{2ρ} g                                                                   (5.11)
///   ∇̃_X Y = ∇_X Y + dρ(X)Y + dρ(Y)X − ⟨X, Y⟩ grad ρ                                               (5.12)
///   dρ = −dU / (2(h − U))                                                                         (5.14)
///
/// Here ρ = ½ ln 2(h − U), X and Y are vector fields, and ⟨ , ⟩ and grad belong to g. The Levi-Civita connections of g
/// and g_h are ∇ and ∇̃. Motions of energy h are the geodesics of g_h, with the arc length ds̃ = 2(h − U) dt (5.2.1).

#include <utility>

#include "mechanics/core/chart_field.h"

namespace pseudorigid::mechanics {

/// A chart with the metric g_h and without forces. The motions of its ChartField are the geodesics of g_h. At points
/// with U ≥ h the metric is not positive definite, and the field fails. C is the chart of g and must have a potential.
template <Chart C>
struct JacobiMetric {
  static constexpr int dimension = C::dimension;
  C chart;
  double h;

  template <class T>
  Eigen::Matrix<T, dimension, dimension> metric(const Coordinates<T, dimension>& q) const {
    const T factor = 2.0 * (h - T(chart.potential(q)));
    Eigen::Matrix<T, dimension, dimension> g = chart.metric(q);
    for (int i = 0; i < dimension; ++i)
      for (int j = 0; j < dimension; ++j) g(i, j) *= factor;
    return g;
  }
};

/// A point of a curve: the n coordinates of the chart C, and as last entry the integral of a function along the curve.
template <Chart C>
using CurveWithIntegral = Coordinates<double, C::dimension + 1>;

/// Geodesics of g_h, with the time t of the motion as the last entry. `acceleration` and `start` fail at points with U
/// ≥ h. `acceleration` also fails if g is not positive definite or a derivative is not finite. A geodesic that starts
/// with unit speed keeps unit speed. The prime denotes d/ds̃:
///   q″ = −Γ(q′, q′) − 2 dρ(q′) q′ + ⟨q′, q′⟩ grad ρ,   t′ = 1/(2(h − U)),   t″ = 2 dU(q′)/(2(h − U))².
template <Chart C>
class JacobiGeodesicField {
 public:
  static constexpr int n = C::dimension;
  using Vector = CurveWithIntegral<C>;
  struct Workspace {};

  JacobiGeodesicField(C chart, double h) : chart_(std::move(chart)), h_(h) {}

  Status acceleration(double, const Vector& x, const Vector& dx, Workspace&, Vector& a) const {
    const ChartVector<C> q = x.template head<n>(), dq = dx.template head<n>();
    const double factor = 2 * (h_ - potential_energy(chart_, q));
    if (Status status = inside(factor); !status) return status;
    const MetricJet<C> jet = metric_jet(chart_, q);
    const ChartVector<C> dU = potential_differential(chart_, q);
    const ChartVector<C> drho = -dU / factor;
    const double speed2 = dq.dot(jet.g * dq);

    ChartVector<C> ddq = speed2 * drho - christoffel_of_first_kind(jet, dq, dq);
    if (Status status = apply_inverse_mass(jet.g, ddq, ddq); !status) return status;
    a.template head<n>() = ddq - 2 * drho.dot(dq) * dq;
    a[n] = 2 * dU.dot(dq) / (factor * factor);
    return {};
  }

  /// Sets the start (x, dx) of the geodesic that follows the motion through (q, v), with unit speed q′ = v/(2(h − U))
  /// (5.18). The caller must ensure that this motion has the energy h.
  Status start(const ChartVector<C>& q, const ChartVector<C>& v, Vector& x, Vector& dx) const {
    const double factor = 2 * (h_ - potential_energy(chart_, q));
    if (Status status = inside(factor); !status) return status;
    x << q, 0;
    dx << v / factor, 1 / factor;
    return {};
  }

  Vector make_vector() const { return Vector::Zero(); }
  Workspace make_workspace() const { return {}; }

 private:
  Status inside(double factor) const {
    if (factor > 0) return {};
    return Status::failure("the Jacobi metric of energy h exists only where U < h");
  }

  C chart_;
  double h_;
};

/// The motion of a conservative chart in the time t, with its length s̃ in the Jacobi metric as the last entry. With
/// the kinetic energy K, ds̃/dt = 2K = 2(h − U), so d²s̃/dt² = −2 dU(q̇).
template <Chart C>
class JacobiLengthField {
 public:
  static constexpr int n = C::dimension;
  using Vector = CurveWithIntegral<C>;
  using Workspace = typename ChartField<C>::Workspace;

  explicit JacobiLengthField(C chart) : motion_(std::move(chart)) {}

  Status acceleration(double t, const Vector& x, const Vector& dx, Workspace& w, Vector& a) const {
    const ChartVector<C> q = x.template head<n>(), v = dx.template head<n>();
    ChartVector<C> ddq;
    if (Status status = motion_.acceleration(t, q, v, w, ddq); !status) return status;
    a << ddq, -2 * potential_differential(motion_.chart(), q).dot(v);
    return {};
  }

  /// Sets the start (x, dx) of the motion through (q, v), with s̃ = 0.
  void start(const ChartVector<C>& q, const ChartVector<C>& v, Vector& x, Vector& dx) const {
    x << q, 0;
    dx << v, 2 * mechanics::kinetic_energy(motion_.chart(), q, v);
  }

  Vector make_vector() const { return Vector::Zero(); }
  Workspace make_workspace() const { return {}; }

 private:
  ChartField<C> motion_;
};

}  // namespace pseudorigid::mechanics
