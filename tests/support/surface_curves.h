#pragma once
/// Curves in charts and their images, for tests of the intrinsic form.

#include <Eigen/Dense>
#include <random>
#include <vector>

#include "mechanics/core/chart.h"

namespace pseudorigid::testing {

/// The 2-jet (q, q̇, q̈) of a curve in a chart of n coordinates.
template <int n>
struct CurveJetIn {
  Eigen::Matrix<double, n, 1> q, v, a;
};
using CurveJet = CurveJetIn<2>;

/// Jets with q in the box [low, high] and velocities and accelerations of order 1; the same every time.
template <int n>
std::vector<CurveJetIn<n>> random_jets_in(const Eigen::Matrix<double, n, 1>& low,
                                          const Eigen::Matrix<double, n, 1>& high, int n_jets) {
  using Vector = Eigen::Matrix<double, n, 1>;
  std::mt19937_64 generator(20260101);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto draw = [&](const Vector& a, const Vector& b) {
    Vector x;
    for (int i = 0; i < n; ++i) x[i] = a[i] + (b[i] - a[i]) * unit(generator);
    return x;
  };
  const Vector one = Vector::Ones();
  std::vector<CurveJetIn<n>> jets;
  for (int k = 0; k < n_jets; ++k) {
    CurveJetIn<n> jet;
    jet.q = draw(low, high);
    jet.v = draw(-one, one);
    jet.a = draw(-one, one);
    jets.push_back(jet);
  }
  return jets;
}
inline std::vector<CurveJet> random_jets(const Eigen::Vector2d& low, const Eigen::Vector2d& high, int n_jets) {
  return random_jets_in<2>(low, high, n_jets);
}

/// The curve's point at time τ = 0 with its derivatives, as a second-order number of τ.
using TimeDual = mechanics::Dual<mechanics::Dual<double, 1>, 1>;

template <int n>
mechanics::Coordinates<TimeDual, n> taylor(const CurveJetIn<n>& c) {
  const mechanics::Coordinates<double, 1> zero(0.0);
  const TimeDual tau = mechanics::independent(mechanics::independent(zero))[0];
  mechanics::Coordinates<TimeDual, n> q;
  for (int i = 0; i < n; ++i) q[i] = c.q[i] + tau * c.v[i] + tau * tau * (0.5 * c.a[i]);
  return q;
}

}  // namespace pseudorigid::testing
