#pragma once
/// Orthonormal polynomials of the point ξ of the unit ball, ∫φ_a φ_b dξ = δ_ab, in order of increasing degree:
///
///   φ_nlm(ξ) = √(2n+3) P_s(2|ξ|² − 1) |ξ|^l Y_lm(ξ/|ξ|),   l = n, n − 2, … ≥ 0,   s = (n − l)/2,   m = −l … l,
///
/// with Jacobi's polynomials P_s = P_s^{(0, l+½)} (Dunkl and Xu, Orthogonal Polynomials of Several Variables, 5.1). The
/// real spherical harmonics Y_lm are proportional to cos mφ (m ≥ 0) or sin |m|φ (m < 0). Recurrences in Cartesian
/// coordinates compute P_s and |ξ|^l Y_lm, so there are no singularities at the poles or the centre. The condition
/// number of the basis is 1 at any degree. The space P_N of polynomials of degree at most N has the first
/// (N+1)(N+2)(N+3)/6 of these functions as its basis. The basis of P_{N−1} is therefore the beginning of the basis of
/// P_N.
///
/// Each polynomial is even or odd in each coordinate. With r = |ξ|, it is the product R_nl(r) Y_lm of a radial and an
/// angular factor.

#include <array>
#include <vector>

#include "mechanics/core/solid_harmonics.h"

namespace pseudorigid::polynomial {

/// The parity of a function: bit i is set if the function is odd in ξ_i, and not set if it is even in ξ_i.
using Parity = unsigned int;

/// The indices of a polynomial φ_nlm.
struct BallPolynomial {
  int n, l, m;

  Parity parity() const {
    const auto [in_x, in_y, in_z] = mechanics::is_odd(l, m);
    return (in_x ? 1U : 0U) | (in_y ? 2U : 0U) | (in_z ? 4U : 0U);
  }
};

/// The indices n, l, m of the basis of P_N, ordered by increasing n, then by decreasing l, then by increasing m.
std::vector<BallPolynomial> ball_polynomials(int N);

/// A value and its gradient with respect to ξ.
using mechanics::Jet;
/// Values and gradients of all polynomials of P_N at a point, in the order of ball_polynomials.
std::vector<Jet> evaluate_ball_polynomials(int N, const std::array<double, 3>& xi);

/// R_nl(r) = √(2n+3) P_s(2r² − 1) r^l, with its derivative in gradient[0].
Jet radial_factor(int n, int l, double r);
using mechanics::solid_harmonics;

}  // namespace pseudorigid::polynomial
