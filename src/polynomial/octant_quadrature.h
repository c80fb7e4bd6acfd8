#pragma once
/// Quadrature on the octant ξ_i > 0 of the unit ball and of its surface. Functions that are even in every coordinate
/// are integrated over the ball by 8 times the octant: of a Gauss rule with 2q points on [−1, 1] the positive half, in
/// |ξ| and in cos θ, and midpoints in the longitude φ,
///
///   ∫f dξ = 8 Σ_ijk w_i r_i² w_j (π/2q) f(r_i, z_j, φ_k),   φ_k = (k + ½) π/2q.
///
/// The q³ points are exact for polynomials of degree 4q − 3 (4q − 1 in cos θ and φ). With q = ⌈(N + 3)/2⌉ that is 2N +
/// 3 at least: the mass, the linear problem and the volume form of the moments are exact.

#include <array>
#include <vector>

namespace pseudorigid::polynomial {

/// Nodes in (0, 1), rising, and weights of the positive half of Gauss's rule with 2q points on [−1, 1].
struct HalfGaussRule {
  std::vector<double> nodes, weights;
};
HalfGaussRule half_gauss_rule(int q);

/// Radius by radius, in the directions of octant_surface_points.
struct WeightedPoint {
  std::array<double, 3> xi;
  double weight;  ///< of the octant
};

/// ∫ over the octant; q³ points.
std::vector<WeightedPoint> octant_points(int q);

/// A point of the sphere with its tangents e_θ, e_φ, of which e_θ × e_φ is the outward normal.
struct SurfacePoint {
  std::array<double, 3> xi, e_theta, e_phi;
  double weight;
};
/// ∫ dA over the octant of the sphere; q² points.
std::vector<SurfacePoint> octant_surface_points(int q);

}  // namespace pseudorigid::polynomial
