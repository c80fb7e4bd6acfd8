#pragma once
/// Search for the critical points of the potential energy V on N = {g = 0}, with the multiplier λ and G = Dg. Newton's
/// iteration from many starting points solves
///
///   r(q, λ) = (∇V − Gᵀλ, g) = 0,   [H_L  −Gᵀ; G  0] δ = −r,   H_L = ∇²V − Σ λ_k D²g_k.
///
/// Here δ is the change of (q, λ). If symmetries make the matrix singular, δ is the shortest solution. δ is halved
/// until |r| decreases, at most 20 times. If |r| does not decrease, the iteration from this starting point ends.
/// Newton's iteration converges to critical points of every Morse index. The random numbers have a fixed seed, so a
/// search is reproducible.
///
/// Each point is listed once; points that differ by periods of the coordinates are the same. Two points with a
/// degenerate Hessian and the same V, nullity and eigenvalues of the Hessian are regarded as points of one orbit of the
/// symmetries. Only one of them is listed.

#include <cstdint>
#include <functional>
#include <vector>

#include "mechanics/equilibria/critical_point.h"

namespace pseudorigid::mechanics {

struct CriticalPointSearch {
  Eigen::VectorXd center{};  // the first starting point; empty: the origin
  double radius = 1;         // half width of the box of starting points, for coordinates that are not periodic
  /// Returns a starting point other than the first one. The argument `uniform` returns uniform random numbers in [0,
  /// 1). If `start` is empty, these starting points are random points of a box about `center`. In a periodic
  /// coordinate, the box contains the whole period.
  std::function<Eigen::VectorXd(const std::function<double()>& uniform)> start{};
  int n_starts = 200;
  std::uint64_t seed = 1;
  /// Returns true if points are known to be missing in the list (morse_count.h). The search calls this function after
  /// each n_starts starting points. If it returns true, the search continues, up to `n_starts_at_most` starting points
  /// in total. If `misses_points` is empty, the search does not continue.
  std::function<bool(const std::vector<CriticalPoint>& points)> misses_points{};
  int n_starts_at_most = 0;
  /// Returns the matrix C of a force −C v that is added to the system's own damping. If `added_damping` is empty, there
  /// is no additional damping.
  std::function<Eigen::MatrixXd(const Eigen::VectorXd& q)> added_damping{};
};

struct CriticalPoints {
  /// Points by increasing V, and by their coordinates if V is equal up to 1e-6. A coordinate with a period P is in
  /// (−P/2, P/2].
  std::vector<CriticalPoint> points;
  int n_starts = 0, n_converged = 0;
  bool misses_points = false;  ///< true if points were known to be missing when the search ended
};

/// Searches for critical points and sets `found`. Fails if the centre of the search has the wrong number of
/// coordinates, or if the motions near a point cannot be computed (describe_critical_point). A starting point without
/// convergence is not a failure. found.n_starts is the number of starting points, and found.n_converged the number of
/// those with convergence.
Status find_critical_points(const AnyLandscape& landscape, const CriticalPointSearch& search, CriticalPoints& found);

/// Searches for critical points, with n_unstable and n_stable as in Oliva, Geometric Mechanics, 5.8.3. This theorem is
/// for systems with damping. If `dissipative` is false, n_unstable and n_stable are therefore counted with an
/// additional force −M v, which replaces search.added_damping. The rates and directions are those without this force.
/// Fails in the same cases as find_critical_points.
Status find_equilibria(const AnyLandscape& landscape, bool dissipative, CriticalPointSearch search,
                       CriticalPoints& found);

}  // namespace pseudorigid::mechanics
