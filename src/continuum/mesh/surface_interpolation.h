#pragma once
/// Functions of the nodes at Gauss points of the free surface, and the forces of the points on the nodes. Face by face,
/// with ℓ_i the Lagrange polynomials on the Gauss–Lobatto nodes and points (ξ_p, ξ_q),
///
///   u = Σ_ij ℓ_i(ξ_p) ℓ_j(ξ_q) u_ij,   ∂u/∂ξ_p = Σ_ij ℓ_i' ℓ_j u_ij,   ∂u/∂ξ_q = Σ_ij ℓ_i ℓ_j' u_ij,
///
/// one direction after the other.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "continuum/mesh/surface_faces.h"

namespace pseudorigid::continuum {

class SurfaceInterpolation {
 public:
  using Field = std::array<std::vector<double>, 3>;  ///< [component][point]
  /// Values and derivatives at the points; or the derivatives of a function of them, by each.
  struct Jets {
    Field u, by_p, by_q;
  };

  /// n_points in a direction of each of this rank's faces on the free surface.
  SurfaceInterpolation(const BallSpace& space, int n_points);

  std::size_t n_points() const { return weights_.size(); }
  /// Weight of the quadrature on [0,1]²; negative if ∂x/∂ξ_p × ∂x/∂ξ_q points inwards.
  const std::vector<double>& weights() const { return weights_; }

  /// For a vector with the ghost nodes of this rank's cells.
  Jets jets(const Vector& u) const;
  /// f_n ← f_n − Σ over points of the derivatives by u, ∂u/∂ξ_p, ∂u/∂ξ_q times those by u_n, f with its ghost nodes.
  void subtract_derivative(const Jets& by_jets, Vector& f) const;

 private:
  std::vector<std::vector<unsigned int>> face_nodes_;  ///< [face][j·n + i], i along p
  Eigen::MatrixXd values_, derivatives_;               ///< ℓ_i and ℓ_i' at the points: [point][i]
  std::vector<double> weights_;
};

}  // namespace pseudorigid::continuum
