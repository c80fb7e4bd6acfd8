#pragma once
/// Nodal functions at Gauss points of the free surface, and the transposed map from forces at these points to nodal
/// forces. The shape functions are products of the Lagrange polynomials ℓ_i on the Gauss–Lobatto nodes. At the point
/// (ξ_p, ξ_q) of a face, a function with the nodal values u_ij has
///
///   u = Σ_ij ℓ_i(ξ_p) ℓ_j(ξ_q) u_ij,   ∂u/∂ξ_p = Σ_ij ℓ_i' ℓ_j u_ij,   ∂u/∂ξ_q = Σ_ij ℓ_i ℓ_j' u_ij.
///
/// The sums are computed one direction after the other. For n points per direction, a face then costs O(n³) operations
/// instead of O(n⁴).

#include <Eigen/Core>
#include <array>
#include <vector>

#include "continuum/mesh/surface_faces.h"

namespace pseudorigid::continuum {

class SurfaceInterpolation {
 public:
  /// Three numbers at each point: [component][point]. The points are ordered by face, then by their index along q; the
  /// index along p is the fastest.
  using Field = std::array<std::vector<double>, 3>;
  /// The values u of a nodal function at the points, and its derivatives by ξ_p and ξ_q. As an argument of
  /// subtract_derivative, the struct contains the derivatives of a function E(u, ∂u/∂ξ_p, ∂u/∂ξ_q) by its three
  /// arguments.
  struct Jets {
    Field u, by_p, by_q;
  };

  /// Uses n_points Gauss points in each direction of a face, on the faces of this rank that belong to the free surface.
  SurfaceInterpolation(const BallSpace& space, int n_points);

  std::size_t n_points() const { return weights_.size(); }
  /// Quadrature weights on [0,1]² at the points. The weights of a face are negative if ∂x/∂ξ_p × ∂x/∂ξ_q points
  /// inwards.
  const std::vector<double>& weights() const { return weights_; }

  /// The jets of u at the points. The ghost nodes of u on the cells of this rank must be up to date.
  Jets jets(const Vector& u) const;
  /// f_n ← f_n − ∂E/∂u_n, by the chain rule. `by_jets` has the derivatives of E with respect to u, ∂u/∂ξ_p and ∂u/∂ξ_q
  /// at the points. The changes for ghost nodes remain in the ghost entries of f. The caller must then add them to the
  /// entries of their owners (add_to_owners).
  void subtract_derivative(const Jets& by_jets, Vector& f) const;

 private:
  std::vector<std::vector<unsigned int>> face_nodes_;  ///< local numbers: [face][j·n + i], i along p, j along q
  Eigen::MatrixXd values_, derivatives_;               ///< ℓ_i and ℓ_i' at the points: [point][i]
  std::vector<double> weights_;
};

}  // namespace pseudorigid::continuum
