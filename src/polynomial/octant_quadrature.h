#pragma once
/// Quadrature on the octant ξ_i > 0 of the unit ball and of its surface. The integral over the ball of a function that
/// is even in every coordinate is 8 times the integral over the octant. For r = |ξ| and for z = cos θ, the quadrature
/// uses the positive half of the Gauss rule with 2q points on [−1, 1]. The nodes r_i and z_j have the weights w_i and
/// w_j. For the longitude φ, the quadrature uses midpoints:
///
///   ∫f dξ = 8 Σ_ijk w_i r_i² w_j π/(2q) f(r_i, z_j, φ_k),   φ_k = (k + ½) π/(2q).
///
/// For polynomials that are even in every coordinate, the quadrature with q³ points is exact up to the degree 4q − 3.
/// In cos θ and φ alone, it is exact up to the degree 4q − 1. A body of degree N uses q = ⌈(N + 3)/2⌉ points in each
/// direction by default. The quadrature is then exact at least up to the degree 2N + 3. The mass matrix, the linear
/// problem about rest and the second moments ∫ρ x xᵀ dX are therefore exact.

#include <array>
#include <vector>

namespace pseudorigid::polynomial {

/// Nodes in (0, 1), in ascending order, and weights of the positive half of the Gauss rule with 2q points on [−1, 1].
struct HalfGaussRule {
  std::vector<double> nodes, weights;
};
HalfGaussRule half_gauss_rule(int q);

/// A quadrature point of the octant of the ball.
struct WeightedPoint {
  std::array<double, 3> xi;
  double weight;  ///< quadrature weight for integrals over the octant
};

/// The q³ points of the octant, ordered by radius. For each radius, the points are in the directions of
/// octant_surface_points, in the same order.
std::vector<WeightedPoint> octant_points(int q);

/// A point of the unit sphere with its tangents e_θ, e_φ. The vector e_θ × e_φ is the outward normal.
struct SurfacePoint {
  std::array<double, 3> xi, e_theta, e_phi;
  double weight;
};
/// The q² points of the octant of the sphere, with the weights w_j π/(2q) for integrals ∫ dA over the octant.
std::vector<SurfacePoint> octant_surface_points(int q);

}  // namespace pseudorigid::polynomial
