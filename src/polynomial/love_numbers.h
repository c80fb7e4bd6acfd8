#pragma once
/// Love numbers (gravity/love_numbers.h) of an incompressible polynomial ball with the radius 1, the density ρ and the
/// gravity g at its surface. The tide V = Y_nm, an orthonormal spherical harmonic, has the generalised force f. It does
/// the work f·w = ρ∮V (w·e) dS on a displacement w, with the outward normal e. The static response u solves K u = f on
/// ker G, with the stiffness K and the derivative G of the constraint (rest_problem.h). The Love numbers are
///
///   h_n = g ∮(u·e) Y_nm dS,    l_n = g/(n(n + 1)) ∮u·∇Y_nm dS.
///
/// The space P_N of polynomials of degree at most N contains the exact response if N > n. Because P_N is invariant
/// under rotations, one m is enough.

#include <vector>

#include "gravity/love_numbers.h"
#include "polynomial/polynomial_body.h"

namespace pseudorigid::polynomial {

/// Sets `numbers` to the Love numbers of `degrees`, for a ball with self-gravity. `degrees` must not be empty, and each
/// degree must be at least 2. The numbers of a degree n > N + 1 are 0, because radial displacements of the surface in
/// P_N have at most the degree N + 1. `setup.reflect` is not used. Fails if make_rest_problem (rest_problem.h) fails,
/// or if the ball at rest is unstable.
mechanics::Status love_numbers(BodySetup setup, const std::vector<int>& degrees,
                               std::vector<gravity::LoveNumbers>& numbers);

}  // namespace pseudorigid::polynomial
