#pragma once
/// Love numbers (gravity/love_numbers.h) of a polynomial ball. The tide V = Y_nm exerts the force f·w = ρ∮V (w·n) dS on
/// a displacement w. The static response u solves K u = f on ker G (rest_problem.h):
///
///   h_n = g ∮(u·n) Y_nm dS,    l_n = g/(n(n + 1)) ∮u·∇Y_nm dS.
///
/// P_N contains the exact response if N > n. It is invariant under rotations, so one m is enough.

#include <vector>

#include "gravity/love_numbers.h"
#include "polynomial/polynomial_body.h"

namespace pseudorigid::polynomial {

/// The numbers of the degrees, for a ball with self-gravity. `setup.reflect` is not used. Fails if the ball is not in a
/// stable equilibrium at rest.
mechanics::Status love_numbers(BodySetup setup, const std::vector<int>& degrees,
                               std::vector<gravity::LoveNumbers>& numbers);

}  // namespace pseudorigid::polynomial
