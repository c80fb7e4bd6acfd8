#pragma once
/// Search for the critical points of V on N = {g = 0}, from many starting points, by Newton's iteration for
///
///   r(q, λ) = (∇V − Gᵀλ, g) = 0,   [H_L  −Gᵀ; G  0] δ = −r,
///
/// with the shortest δ if the matrix is singular (symmetries), halved until |r| falls. Newton's iteration is drawn
/// to critical points of every index alike. The seeds are fixed: the same search gives the same result.
///
/// A point is counted once: modulo the periods of the chart, and, where it is degenerate (a whole orbit of symmetries
/// is critical), once for each value of V and spectrum of H.

#include <cstdint>
#include <functional>
#include <vector>

#include "mechanics/equilibria/critical_point.h"

namespace pseudorigid::mechanics {

struct CriticalPointSearch {
  Eigen::VectorXd center{};  // empty: 0. The first start
  double radius = 1;         // half width of the box of starts, in coordinates that are not periodic
  /// A further start from uniform numbers in [0, 1), in place of the box.
  std::function<Eigen::VectorXd(const std::function<double()>& uniform)> start{};
  int n_starts = 200;
  std::uint64_t seed = 1;
  /// Called after n_starts and from time to time: whether points are known to be missing (morse_count.h). The search
  /// then continues, up to `n_starts_at_most`.
  std::function<bool(const std::vector<CriticalPoint>& points)> misses_points{};
  int n_starts_at_most = 0;
  /// Linear damping in addition to the system's own: q → C(q) of the force −C v. Empty: none.
  std::function<Eigen::MatrixXd(const Eigen::VectorXd& q)> added_damping{};
};

struct CriticalPoints {
  std::vector<CriticalPoint> points;  // by rising V
  int n_starts = 0, n_converged = 0;
  bool misses_points = false;  ///< whether points were known to be missing when the search ended
};

/// Fails if a point that was found cannot be described; n_converged shows how many starts led to a point.
Status find_critical_points(const AnyLandscape& landscape, const CriticalPointSearch& search, CriticalPoints& found);

/// The same, with n_unstable and n_stable as in 5.8.3: if the system does not have a dissipation of its own, they are
/// counted under the force −M v. The rates belong to the system itself.
Status find_equilibria(const AnyLandscape& landscape, bool dissipative, CriticalPointSearch search,
                       CriticalPoints& found);

}  // namespace pseudorigid::mechanics
