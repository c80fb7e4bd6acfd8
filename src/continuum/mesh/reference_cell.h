#pragma once
/// One-dimensional tables of the reference cell [0,1]: two quadrature rules and three matrices. The Gauss–Lobatto rule
/// gives the nodes of the displacements and the lumped mass. The Gauss rule gives the points for the integrals of
/// forces and of the constraint. Two of the matrices are
///
///   interpolate[q][i] = ℓ_i(ξ_q),   differentiate[q][p] = ℓ̂_p'(ξ_q),
///
/// with the Lagrange polynomials ℓ_i on the Gauss–Lobatto nodes and ℓ̂_p on the Gauss points ξ_q. `interpolate` maps
/// nodal values to values at the points. `differentiate` maps values at the points to derivatives at the points. The
/// third matrix, `differentiate_at_nodes`, maps nodal values to derivatives at the nodes.

#include <array>
#include <vector>

namespace pseudorigid::continuum {

/// `lagrange` returns the value at y of the Lagrange polynomial that is 1 at x[i] and 0 at the other x[j].
/// `lagrange_derivative` returns the derivative of this polynomial at y. The x[j] must be distinct.
double lagrange(const std::vector<double>& x, std::size_t i, double y);
double lagrange_derivative(const std::vector<double>& x, std::size_t i, double y);

struct ReferenceCell {
  explicit ReferenceCell(int degree);
  /// Weight of the Gauss point q of the cell. The first direction is the fastest index of the points.
  double weight_of_point(int q) const {
    return point_weights[q % n] * point_weights[q / n % n] * point_weights[q / n / n];
  }

  int n;                                       ///< number of nodes and of Gauss points per direction: degree + 1
  std::vector<double> nodes, node_weights;     ///< nodes and weights of the Gauss–Lobatto rule
  std::vector<double> points, point_weights;   ///< points and weights of the Gauss rule
  std::vector<double> interpolate;             ///< ℓ_i(ξ_q), row-major [q][i]
  std::vector<double> differentiate;           ///< ℓ̂_p'(ξ_q), row-major [q][p]
  std::vector<double> differentiate_at_nodes;  ///< ℓ_j' at node i, row-major [i][j]
};

}  // namespace pseudorigid::continuum
