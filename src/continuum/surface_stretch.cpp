#include "continuum/surface_stretch.h"

#include <Eigen/Dense>
#include <cmath>

#include "continuum/ghost_values.h"
#include "continuum/node_gradients.h"
#include "continuum/ranks.h"

namespace pseudorigid::continuum {
namespace {

using Tangents = Eigen::Matrix<double, 3, 2>;

/// The two columns of a gradient by ξ that lie in the faces with normal direction d.
Tangents tangents(const Eigen::Matrix3d& gradient, int d) {
  Tangents t;
  t << gradient.col((d + 1) % 3), gradient.col((d + 2) % 3);
  return t;
}

/// λ₁²λ₂, from trace and determinant of C₀⁻¹c.
double stretch_ratio(const Tangents& before, const Tangents& after) {
  const Eigen::Matrix2d A = (before.transpose() * before).inverse() * (after.transpose() * after);
  const double half_trace = A.trace() / 2, product = A.determinant();
  const double larger = half_trace + std::sqrt(std::max(0.0, half_trace * half_trace - product));
  return product / std::sqrt(larger);  // λ₁²λ₂² / λ₂
}

/// Nodes of a cell on its face number f (deal.II's: normal direction f/2, at ξ = f%2).
bool is_on_face(int node, unsigned int f, int n) {
  const int stride = f / 2 == 0 ? 1 : f / 2 == 1 ? n : n * n;
  return node / stride % n == (f % 2 == 0 ? 0 : n - 1);
}

}  // namespace

LeastPlace least_surface_stretch(const BallSpace& space, const Vector& x) {
  LeastPlace least;
  const GhostValues ghosts(x);
  const ReferenceCell& ref = space.reference_cell();
  unsigned int c = 0;
  for (const auto& cell : space.mesh().triangulation().active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    const unsigned int own = c++;
    for (const unsigned int f : cell->face_indices()) {
      if (!cell->face(f)->at_boundary() || cell->face(f)->boundary_id() != BallMesh::surface_id) continue;
      const Eigen::Matrix3Xd X = nodal_values(space, space.reference_positions(), own), y = nodal_values(space, x, own);
      for (int i = 0; i < static_cast<int>(space.nodes_per_cell()); ++i) {
        if (!is_on_face(i, f, ref.n)) continue;
        const int d = static_cast<int>(f / 2);
        const double ratio =
            stretch_ratio(tangents(reference_gradient(ref, X, i), d), tangents(reference_gradient(ref, y, i), d));
        least.take(ratio, {X(0, i), X(1, i), X(2, i)});
      }
    }
  }
  if (n_ranks(space.communicator()) > 1) least.take_others(space.communicator());
  return least;
}

}  // namespace pseudorigid::continuum
