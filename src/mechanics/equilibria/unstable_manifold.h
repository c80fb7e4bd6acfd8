#pragma once
/// One branch of the unstable manifold of a critical point, as the motion that leaves it along an unstable direction:
///
///   q(0) = q* + ε δ,   q̇(0) = ε z δ,   z > 0 a real rate with direction δ, |δ| = 1 in the metric,
///
/// which is on the manifold up to O(ε²), and how near it comes to another critical point, in (q, q̇), that is, whether
/// it is a connection of the two (Oliva, Geometric Mechanics, 5.8.6, 5.8.8).

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "mechanics/equilibria/critical_point.h"
#include "mechanics/methods/dormand_prince_8.h"

namespace pseudorigid::mechanics {

struct UnstableBranch {
  double epsilon = 1e-6;  // distance from the critical point at the start; < 0: the opposite branch
  double end_time = 100;
  double tolerance = 1e-13;
};

template <SecondOrderField F>
struct BranchOutcome {
  double nearest = std::numeric_limits<double>::infinity();  // |(q − q_target, q̇)|, of all steps
  double t_nearest = 0;
  State<F> end;
};

/// |(q − q₀, q̇)|, with coordinates of a period P > 0 taken modulo P.
template <class Vector>
double phase_distance(const Vector& q, const Vector& v, const Eigen::VectorXd& q0, const Eigen::VectorXd& periods) {
  Eigen::VectorXd d = q - q0;
  for (Eigen::Index i = 0; i < d.size(); ++i)
    if (periods[i] > 0) d[i] = std::remainder(d[i], periods[i]);
  return std::hypot(d.norm(), v.norm());
}

/// Follows the branch of the fastest real unstable rate of `from` for its time, watching its distance to `target`.
template <SecondOrderField F>
Status follow_unstable_branch(const F& field, const CriticalPoint& from, const CriticalPoint& target,
                              const Eigen::VectorXd& periods, const UnstableBranch& branch, BranchOutcome<F>& outcome) {
  Eigen::Index fastest = -1;
  for (Eigen::Index i = 0; i < from.rates.size(); ++i)
    if (from.rates[i].imag() == 0 && from.rates[i].real() > 0 &&
        (fastest < 0 || from.rates[i].real() > from.rates[fastest].real()))
      fastest = i;
  if (from.n_unstable == 0 || fastest < 0) return Status::failure("the critical point has no real unstable direction");

  Eigen::VectorXd delta = from.directions.col(fastest).real();
  Eigen::Index largest;
  delta.cwiseAbs().maxCoeff(&largest);
  if (delta[largest] < 0) delta = -delta;  // which branch ε > 0 means does not depend on the eigensolver

  State<F> state{0, from.q + branch.epsilon * delta, branch.epsilon * from.rates[fastest].real() * delta};
  DormandPrince8Workspace<F> w(field, branch.tolerance);
  outcome.nearest = std::numeric_limits<double>::infinity();
  while (state.t < branch.end_time) {
    if (Status status = DormandPrince8::step(field, branch.end_time, state, w); !status) return status;
    if (const double d = phase_distance(state.q, state.v, target.q, periods); d < outcome.nearest) {
      outcome.nearest = d;
      outcome.t_nearest = state.t;
    }
  }
  outcome.end = state;
  return {};
}

}  // namespace pseudorigid::mechanics
