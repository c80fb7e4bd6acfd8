#pragma once
/// Morse's relations between the numbers of critical points of a function V. Let D be a compact part of a manifold of
/// dimension n, with V increasing outwards at its boundary. Let all critical points of V in D be nondegenerate, and let
/// c_k be the number of points with Morse index k. With the Betti numbers b_k of D (coefficients in Z/2),
///
///   Σ c_k t^k − Σ b_k t^k = (1 + t) Σ r_k t^k,   r_k ≥ 0      (Milnor, Morse Theory, 5)
///
/// Therefore r_k = Σ_{j ≤ k} (−1)^{k−j}(c_j − b_j) ≥ 0 and r_n = 0. A list of critical points that violates this
/// condition is not complete.

#include <span>
#include <vector>

namespace pseudorigid::mechanics {

/// Returns true if a list of points with these Morse indices satisfies the condition, so that the list can be complete.
/// `dimension` is n. `betti` has at most n + 1 Betti numbers; missing numbers are 0.
bool obeys_morse(const std::vector<int>& indices, int dimension, std::span<const int> betti);

}  // namespace pseudorigid::mechanics
