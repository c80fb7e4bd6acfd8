#include "continuum/output/surface_stretch.h"

#include <Eigen/Dense>
#include <cmath>

#include "continuum/kernels/node_gradients.h"
#include "continuum/mesh/surface_faces.h"
#include "continuum/parallel/ghost_values.h"
#include "continuum/parallel/ranks.h"

namespace pseudorigid::continuum {
namespace {

using Tangents = Eigen::Matrix<double, 3, 2>;

/// Returns the two columns of a gradient such as ∂x/∂ξ that are tangent to a face ξ_d = const.
Tangents tangents(const Eigen::Matrix3d& gradient, int d) {
  Tangents t;
  t << gradient.col((d + 1) % 3), gradient.col((d + 2) % 3);
  return t;
}

/// The ratio λ₁²λ₂ (surface_stretch.h), computed from the trace and the determinant of C₀⁻¹c. `before` and `after`
/// contain the tangents before and after the deformation.
double stretch_ratio(const Tangents& before, const Tangents& after) {
  const Eigen::Matrix2d A = (before.transpose() * before).inverse() * (after.transpose() * after);
  const double half_trace = A.trace() / 2, product = A.determinant();
  const double larger = half_trace + std::sqrt(std::max(0.0, half_trace * half_trace - product));
  return product / std::sqrt(larger);  // product = λ₁²λ₂², √larger = λ₂
}

}  // namespace

LeastPlace least_surface_stretch(const BallSpace& space, const Vector& x) {
  LeastPlace least;
  const GhostValues ghosts(x);
  const ReferenceCell& ref = space.reference_cell();
  for (const CellFace& face : free_surface(space)) {
    const Eigen::Matrix3Xd X = nodal_values(space, space.reference_positions(), face.cell),
                           y = nodal_values(space, x, face.cell);
    for (const int i : nodes_of(face, ref.n)) {
      const double ratio = stretch_ratio(tangents(reference_gradient(ref, X, i), face.direction),
                                         tangents(reference_gradient(ref, y, i), face.direction));
      least.take(ratio, {X(0, i), X(1, i), X(2, i)});
    }
  }
  return least_over_ranks(least, space.communicator());
}

}  // namespace pseudorigid::continuum
