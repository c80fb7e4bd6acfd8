#pragma once
/// Love numbers (gravity/love_numbers.h) of an incompressible polynomial ball with the density ρ and the gravity g at
/// its surface. The tide V = Y_nm, an orthonormal spherical harmonic, does the work f·w = ρ∮V (w·e) dS on a
/// displacement w. The outward normal is e. The static response u solves K u = f on ker G, with the stiffness K and the
/// derivative G of the constraint (rest_problem.h). The Love numbers are
///
///   h_n = g ∮(u·e) Y_nm dS,    l_n = g/(n(n + 1)) ∮u·∇Y_nm dS.
///
/// The space P_N of polynomials of degree at most N contains the exact response if N > n. Because P_N is invariant
/// under rotations, one m is enough.

#include <vector>

#include "gravity/love_numbers.h"
#include "polynomial/polynomial_body.h"

namespace pseudorigid::polynomial {

/// Sets `numbers` to the Love numbers of `degrees`, for a ball with self-gravity. `degrees` must not be empty. For
/// degrees n > N + 1 they are 0, because P_N does not contain the displacement of the surface. `setup.reflect` is not
/// used. Fails if make_rest_problem (rest_problem.h) fails, or if the ball at rest is unstable.
mechanics::Status love_numbers(BodySetup setup, const std::vector<int>& degrees,
                               std::vector<gravity::LoveNumbers>& numbers);

}  // namespace pseudorigid::polynomial
