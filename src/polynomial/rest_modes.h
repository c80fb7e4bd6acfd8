#pragma once
/// Small motions of a polynomial ball about rest,
///
///   K u = ω² u on ker G     (rest_problem.h),
///
/// a problem for each of the eight parities on an orthonormal basis of ker G without the six rigid motions. All other
/// frequencies of the body are found, those of unstable motions among them.
///
/// Kind and degree of a mode are measured: P_N is invariant under turns, and the square of a turn of the whole field
/// (turns.h) splits a parity into motions of one degree n each. A mode has the degree of which its share is largest. It
/// is spheroidal if its inversion X ↦ −X has the sign (−1)^(n+1), and otherwise toroidal.

#include <vector>

#include "polynomial/polynomial_body.h"

namespace pseudorigid::polynomial {

/// One frequency of the ball with its 2n + 1 modes. Internal units. For unstable motions ω is negative, and −ω is the
/// growth rate.
struct RestFrequency {
  double omega;           ///< mean of the copies
  double least, largest;  ///< of the copies
  bool spheroidal;
  int degree;
  int overtone;           ///< 0: the lowest of its kind and degree
  double share;           ///< least share of the degree in a copy
  Eigen::VectorXd shape;  ///< one of the modes, coefficients of the whole body, of norm 1
};

/// The lowest `number` frequencies, rising. `setup.reflect` is not used. Fails if the body is in no equilibrium at
/// rest, and if modes cannot be put together to frequencies.
mechanics::Status rest_frequencies(BodySetup setup, bool incompressible, std::size_t number,
                                   std::vector<RestFrequency>& frequencies);

}  // namespace pseudorigid::polynomial
