#pragma once
/// Love numbers (gravity/love_numbers.h) of the finite-element ball with the density ρ and the gravity g at its
/// surface. The potential V = Y_nm of the tide is an orthonormal spherical harmonic. Its force f does the work f·w =
/// ρ∮V (w·e) dS on a displacement w, with the outward normal e = X/|X|. K is the elastic stiffness, K_g the second
/// variation of self-gravity, G the derivative of the constraint, and λ its multiplier (parity_sector.h,
/// rest_problem.h). The static response u and the Love numbers satisfy
///
///   (K + K_g) u − Gᵀλ = f,   G u = 0,
///   h_n = g ∮(u·e) Y_nm dS,    l_n = g/(n(n + 1)) ∮u·∇Y_nm dS.
///
/// The computation uses the harmonics Y_nm that are even under all three reflections of the octant if n is even, and
/// odd under all three if n is odd. No rigid motion has these parities. The mesh breaks the symmetry between the
/// harmonics of one degree. The result is therefore the mean over the computed harmonics. The difference between the
/// largest and the smallest number is of the size of the error of the mesh.

#include <vector>

#include "continuum/modes/rest_problem.h"
#include "continuum/parallel/sector_ranks.h"
#include "gravity/love_numbers.h"

namespace pseudorigid::continuum {

/// The Love numbers of one degree: the means over the computed harmonics. The spreads of h and of l are the differences
/// between the largest and the smallest number.
struct BallLoveNumbers {
  gravity::LoveNumbers mean;
  double spread_of_h = 0, spread_of_l = 0;
};

/// Sets `numbers` to the Love numbers of the `degrees`, each at least 2, for an incompressible ball with self-gravity.
/// The computation replaces the shift of `problem` by 0. Fails if the ball is not stable at rest, or if the conjugate
/// gradients do not converge. With several `ranks`, two of them solve for the even and the odd degrees, and the
/// function is collective.
mechanics::Status love_numbers(RestProblem problem, const std::vector<int>& degrees,
                               std::vector<BallLoveNumbers>& numbers, const SectorRanks& ranks = {});

}  // namespace pseudorigid::continuum
