#pragma once
/// The faces of the finite elements, the nodes of the faces, and Gauss quadrature on the faces. A face is the part of a
/// cell with ξ_d = 0 or ξ_d = 1. The local directions p = d + 1 and q = d + 2 (mod 3) span the face, so ∂X/∂ξ_p ×
/// ∂X/∂ξ_q points to increasing ξ_d.

#include <Eigen/Core>
#include <vector>

#include "continuum/mesh/ball_space.h"

namespace pseudorigid::continuum {

struct CellFace {
  unsigned int cell;  ///< index of the cell on this rank
  int direction;      ///< local direction d across the face
  int end;            ///< value of ξ_d on the face, 0 or 1

  /// Number of the face among the six faces of a cell in deal.II.
  unsigned int number() const { return 2 * direction + end; }
};

/// Calls visit(face, cell iterator, is_on_free_surface) for all faces of the cells of this rank. An inner face is
/// visited once for each of its cells.
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

/// The faces on the free surface that belong to cells of this rank.
std::vector<CellFace> free_surface(const BallSpace& space);

/// The nodes of a face by their numbers in the cell. For n nodes per direction, entry j·n + i is node i along p and
/// node j along q.
std::vector<int> nodes_of(const CellFace& face, int n);

/// A Gauss point of a face, with the basis functions of the nodes of the face.
struct FacePoint {
  /// The values at the point of the basis function of the node with the local number `node`, and of its derivatives by
  /// ξ_p and ξ_q. A nodal function u has the value Σ value u_node and the derivatives Σ by_p u_node and Σ by_q u_node
  /// at the point.
  struct Node {
    unsigned int node;
    double value, by_p, by_q;
  };
  /// The value of a nodal function and its derivatives along the face.
  struct Jet {
    Eigen::Vector3d u, by_p, by_q;
  };
  std::vector<Node> nodes;
  double weight;  ///< quadrature weight on [0,1]²

  /// `value` and `jet` evaluate a nodal function u at the point. The ghost nodes of u on the cells of this rank must be
  /// up to date.
  Eigen::Vector3d value(const Vector& u) const;
  Jet jet(const Vector& u) const;
};

/// The points of the Gauss rule on a face of a cell of this rank, with n_points points in each direction. The index
/// along q is the fastest.
std::vector<FacePoint> quadrature_on(const BallSpace& space, const CellFace& face, int n_points);

}  // namespace pseudorigid::continuum
