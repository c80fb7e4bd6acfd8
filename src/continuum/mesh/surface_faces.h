#pragma once
/// The faces of the finite elements, their nodes, and the Gauss rule on them. A face is ξ_d = 0 or 1 of a cell; the
/// local directions p = d + 1, q = d + 2 (mod 3) span it, so that ∂X/∂ξ_p × ∂X/∂ξ_q points to rising ξ_d.

#include <Eigen/Core>
#include <vector>

#include "continuum/mesh/ball_space.h"

namespace pseudorigid::continuum {

struct CellFace {
  unsigned int cell;  ///< of this rank
  int direction;      ///< d
  int end;            ///< ξ_d

  /// deal.II's number of the face.
  unsigned int number() const { return 2 * direction + end; }
};

/// Calls visit(face, iterator of its cell, whether it is on the free surface) for all faces of this rank's cells.
template <class Visit>
void visit_faces(const BallSpace& space, Visit&& visit) {
  unsigned int own = 0;
  for (const auto& cell : space.mesh().triangulation().active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    for (int direction = 0; direction < 3; ++direction)
      for (const int end : {0, 1}) {
        const CellFace face{own, direction, end};
        const auto there = cell->face(face.number());
        visit(face, cell, there->at_boundary() && there->boundary_id() == BallMesh::surface_id);
      }
    ++own;
  }
}

/// The faces of this rank's cells on the free surface.
std::vector<CellFace> free_surface(const BallSpace& space);

/// The nodes of a face by their numbers in the cell, of n in a direction: [j·n + i], i along p, j along q.
std::vector<int> nodes_of(const CellFace& face, int n);

/// A Gauss point of a face.
struct FacePoint {
  /// A function is u = Σ value u_node there, with ∂u/∂ξ_p = Σ by_p u_node and ∂u/∂ξ_q likewise.
  struct Node {
    unsigned int node;
    double value, by_p, by_q;
  };
  /// A function of the nodes, and its derivatives along the face.
  struct Jet {
    Eigen::Vector3d u, by_p, by_q;
  };
  std::vector<Node> nodes;
  double weight;  ///< on [0,1]²

  /// For a vector with the ghost nodes of this rank's cells.
  Eigen::Vector3d value(const Vector& u) const;
  Jet jet(const Vector& u) const;
};

/// The Gauss rule with n_points in a direction.
std::vector<FacePoint> quadrature_on(const BallSpace& space, const CellFace& face, int n_points);

}  // namespace pseudorigid::continuum
