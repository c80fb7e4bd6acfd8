#pragma once
/// Small motions of a polynomial ball about rest,
///
///   K u = ω² u on ker G,   K = D²V − Σ_b λ_b D²g_b   at x = X with its multiplier λ,
///
/// from dense matrices. A motion is even or odd under each reflection of a coordinate plane, so that K and G fall into
/// eight parts (u_i has the parity of the part with bit i changed, the constraints that of the part), and each part is
/// an eigenvalue problem on an orthonormal basis of ker G. All frequencies of the body are found.
///
/// The basis is made of |ξ|^l Y_lm, and a toroidal motion of degree n has l = n in every component, a spheroidal one
/// l = n ± 1: that tells kind and degree of a mode.

#include <vector>

#include "polynomial/polynomial_body.h"

namespace pseudorigid::polynomial {

/// One frequency of the ball with its 2n + 1 modes. Internal units.
struct RestFrequency {
  double omega;           ///< mean of the copies
  double least, largest;  ///< of the copies
  bool spheroidal;
  int degree;
  int overtone;           ///< 0: the lowest of its kind and degree
  Eigen::VectorXd shape;  ///< one of the modes, coefficients of the whole body, of norm 1
};

/// The lowest `number` frequencies above 0, rising. `setup.reflect` is not used. Fails where the body is in no
/// equilibrium at rest.
mechanics::Status rest_frequencies(BodySetup setup, bool incompressible, std::size_t number,
                                   std::vector<RestFrequency>& frequencies);

}  // namespace pseudorigid::polynomial
