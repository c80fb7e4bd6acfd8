#pragma once
/// The potential landscape (landscape.h) of a system in a chart with metric g, potential U and force F
/// (mechanics/core/chart.h). The landscape has no constraint, and its mass is M = g(q). Automatic differentiation gives
/// the derivatives of U. The damping is C = −∂F/∂v at v = 0 and t = 0, computed by differences.

#include <utility>

#include "mechanics/core/central_difference.h"
#include "mechanics/core/chart_field.h"
#include "mechanics/equilibria/landscape.h"

namespace pseudorigid::mechanics {

template <HasPotential C>
class ChartLandscape {
 public:
  using Vector = ChartVector<C>;
  static constexpr int n = C::dimension;

  explicit ChartLandscape(C chart) : field_(std::move(chart)) {}

  int n_coordinates() const { return n; }
  int n_constraints() const { return 0; }
  Eigen::VectorXd periods() const {
    Eigen::VectorXd P = Eigen::VectorXd::Zero(n);
    if constexpr (HasPeriods<C>) copy(chart().periods(), P);
    return P;
  }
  double potential(const Vector& q) const { return chart().potential(q); }
  Status gradient(const Vector& q, Eigen::VectorXd& dV) const {
    copy(potential_differential(chart(), q), dV);
    return finite(dV);
  }
  Status constraint(const Vector&, Eigen::VectorXd& g) const {
    g.resize(0);
    return {};
  }
  void constraint_gradient(const Vector&, Eigen::MatrixXd& G) const { G.resize(0, n); }
  Status hessian(const Vector& q, const Eigen::VectorXd&, Eigen::MatrixXd& H) const {
    copy(second_order_jet<n>([this](const auto& x) { return chart().potential(x); }, q).hessian, H);
    return finite(H);
  }
  void mass(const Vector& q, Eigen::MatrixXd& M) const { copy(ChartMatrix<C>(chart().metric(q)), M); }
  Status damping(const Vector& q, Eigen::MatrixXd& damping) const {
    damping.setZero(n, n);
    if constexpr (ChartField<C>::velocity_dependent()) {
      constexpr double h = 0.01;
      for (int j = 0; j < n; ++j) {
        Vector rate = Vector::Zero();
        const auto F = [&](double s, Vector& f) {
          f = field_.force(0, q, s * Vector::Unit(j));
          return finite(f);
        };
        if (Status status = central_difference(F, h, rate); !status) return status;
        damping.col(j) = -rate;
      }
    }
    return {};
  }

 private:
  const C& chart() const { return field_.chart(); }
  /// Copies entry by entry, because g++ 12 wrongly warns that an Eigen copy of a single entry reads beyond this entry.
  static void copy(const auto& from, auto& to) {
    to.resize(from.rows(), from.cols());
    for (Eigen::Index i = 0; i < from.size(); ++i) to.data()[i] = from.data()[i];
  }
  static Status finite(const auto& x) {
    return x.allFinite() ? Status() : Status::failure("the potential is not finite in this place of the chart");
  }

  ChartField<C> field_;
};

}  // namespace pseudorigid::mechanics
