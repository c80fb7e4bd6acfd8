#pragma once
/// Love numbers (gravity/love_numbers.h) of the finite-element ball: the static response (K + K_g) u − Gᵀλ = f, G u = 0
/// (parity_sector.h with s = 0) to the force f·w = ρ∮V (w·n) dS of a tide V = Y_nm at the surface,
///
///   h_n = g ∮(u·e) Y_nm dS,    l_n = g/(n(n + 1)) ∮u·∇Y_nm dS,    e = X/|X|.
///
/// Tides of even n are even at all three planes of the octant, and those of odd n odd: no rigid motion has these
/// parities. The mesh tells the harmonics of one degree apart, so their mean is taken and their spread is an error of
/// the mesh.

#include <vector>

#include "continuum/modes/parity_sector.h"
#include "gravity/love_numbers.h"

namespace pseudorigid::continuum {

/// The numbers of a degree, and (largest − smallest) of its harmonics.
struct BallLoveNumbers {
  gravity::LoveNumbers mean;
  double spread_of_h = 0, spread_of_l = 0;
};

/// For an incompressible ball with self-gravity. Fails if the ball is not stable at rest.
mechanics::Status love_numbers(RestProblem problem, const std::vector<int>& degrees,
                               std::vector<BallLoveNumbers>& numbers);

}  // namespace pseudorigid::continuum
