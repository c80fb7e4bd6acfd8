#pragma once
/// Search for the critical points of V on N = {g = 0}. Newton's iteration from many starting points solves
///
///   r(q, λ) = (∇V − Gᵀλ, g) = 0,   [H_L  −Gᵀ; G  0] δ = −r,   H_L = ∇²V − Σ λ_k D²g_k.
///
/// If the matrix is singular (symmetries), δ is the shortest solution. δ is halved until |r| decreases. Newton's
/// iteration converges to critical points of every index. The random numbers have a fixed seed, so a search is
/// reproducible.
///
/// Each point is listed once, modulo the periods of the chart. Degenerate points, for example on a critical orbit of
/// symmetries, are listed once for each value of V and spectrum of the Hessian.

#include <cstdint>
#include <functional>
#include <vector>

#include "mechanics/equilibria/critical_point.h"

namespace pseudorigid::mechanics {

struct CriticalPointSearch {
  Eigen::VectorXd center{};  // the first start; empty: 0
  double radius = 1;         // half width of the box of starts, for coordinates that are not periodic
  /// Makes a start from uniform random numbers in [0, 1), instead of a start in the box.
  std::function<Eigen::VectorXd(const std::function<double()>& uniform)> start{};
  int n_starts = 200;
  std::uint64_t seed = 1;
  /// Called after each n_starts starts. If it returns true, points are known to be missing (morse_count.h), and the
  /// search continues up to `n_starts_at_most`.
  std::function<bool(const std::vector<CriticalPoint>& points)> misses_points{};
  int n_starts_at_most = 0;
  /// Matrix C(q) of a linear damping −C v in addition to the system's own; empty: none.
  std::function<Eigen::MatrixXd(const Eigen::VectorXd& q)> added_damping{};
};

struct CriticalPoints {
  std::vector<CriticalPoint> points;  // by increasing V
  int n_starts = 0, n_converged = 0;
  bool misses_points = false;  ///< points were known to be missing when the search ended
};

/// Searches for critical points. Fails if a point cannot be described. n_converged is the number of starts that led to
/// a point.
Status find_critical_points(const AnyLandscape& landscape, const CriticalPointSearch& search, CriticalPoints& found);

/// The same, with n_unstable and n_stable as in Oliva 5.8.3. If the system has no dissipation, these numbers are
/// counted with the additional force −M v. The rates are those of the system without this force.
Status find_equilibria(const AnyLandscape& landscape, bool dissipative, CriticalPointSearch search,
                       CriticalPoints& found);

}  // namespace pseudorigid::mechanics
