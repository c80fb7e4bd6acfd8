#pragma once
/// Curves in charts and their images, for tests of the intrinsic form.

#include <Eigen/Dense>
#include <random>

#include "mechanics/core/chart.h"

namespace pseudorigid::testing {

/// The 2-jet (q, q̇, q̈) of a curve in a chart of two coordinates.
struct CurveJet {
  Eigen::Vector2d q, v, a;
};

/// Jets with q in the box [low, high] and velocities and accelerations of order 1; the same every time.
inline std::vector<CurveJet> random_jets(const Eigen::Vector2d& low, const Eigen::Vector2d& high, int n) {
  std::mt19937_64 generator(20260101);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto draw = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) -> Eigen::Vector2d {
    return {a[0] + (b[0] - a[0]) * unit(generator), a[1] + (b[1] - a[1]) * unit(generator)};
  };
  const Eigen::Vector2d one = Eigen::Vector2d::Ones();
  std::vector<CurveJet> jets;
  for (int k = 0; k < n; ++k) jets.push_back({draw(low, high), draw(-one, one), draw(-one, one)});
  return jets;
}

/// The curve's point at time τ = 0 with its derivatives, as a second-order number of τ.
using TimeDual = mechanics::Dual<mechanics::Dual<double, 1>, 1>;

inline mechanics::Coordinates<TimeDual, 2> taylor(const CurveJet& c) {
  const mechanics::Coordinates<double, 1> zero(0.0);
  const TimeDual tau = mechanics::independent(mechanics::independent(zero))[0];
  mechanics::Coordinates<TimeDual, 2> q;
  for (int i = 0; i < 2; ++i) q[i] = c.q[i] + tau * c.v[i] + tau * tau * (0.5 * c.a[i]);
  return q;
}

}  // namespace pseudorigid::testing
