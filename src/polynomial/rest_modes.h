#pragma once
/// Small motions u of a polynomial ball of degree N about rest. With the stiffness K and the derivative G of the
/// constraint (rest_problem.h), the squares of the frequencies ω are the eigenvalues of K on ker G. For a compressible
/// ball, ker G is the space of all motions.
///
/// Motions of different parity are not coupled, so each of the eight parities (parity_parts.h) has such a problem. The
/// problem is solved on an orthonormal basis of the motions in ker G that are orthogonal to the six rigid motions. The
/// result therefore has all frequencies except those of rigid motions, and includes unstable motions.
///
/// The kind and the degree n of a mode are computed from its shape. The polynomials of degree at most N are invariant
/// under rotations. With the joint rotations J_e of space and ball about the axes e (turns.h), the operator −Σ_e J_e²
/// has the eigenvalues n(n + 1). The motions of a parity are sums of eigenvectors of this operator. The degree of a
/// mode is the degree n with the largest share of |u|² in such a sum. A mode is spheroidal if u(−X) = (−1)^(n+1) u(X),
/// and otherwise toroidal.

#include <vector>

#include "polynomial/polynomial_body.h"

namespace pseudorigid::polynomial {

/// A frequency of the ball in internal units. A frequency of degree n has 2n + 1 modes. An unstable motion has ω < 0
/// and grows at the rate −ω.
struct RestFrequency {
  double omega;           ///< mean over the 2n + 1 modes
  double least, largest;  ///< least and largest ω of the 2n + 1 modes
  bool spheroidal;
  int degree;
  int overtone;           ///< 0 for the lowest frequency of this kind and degree
  double share;           ///< share of the degree n in |u|², the least over the 2n + 1 modes
  Eigen::VectorXd shape;  ///< coefficients of one of the modes on the whole body, with the norm 1
};

/// Sets `frequencies` to the lowest `number` frequencies in ascending order, or to all if there are fewer.
/// `setup.reflect` is not used. Fails if make_rest_problem (rest_problem.h) fails, or if the modes cannot be grouped
/// into complete frequencies.
mechanics::Status rest_frequencies(BodySetup setup, bool incompressible, std::size_t number,
                                   std::vector<RestFrequency>& frequencies);

}  // namespace pseudorigid::polynomial
