#include "continuum/modes/rest_problem.h"

#include <algorithm>
#include <cmath>

#include "continuum/modes/surface_harmonics.h"

namespace pseudorigid::continuum {
RestProblem::RestProblem(const BallSpace& ball_space, const CellKernels& kernels, const StoredEnergy& stored,
                         bool is_incompressible, double gravity_constant, std::size_t most_coupled)
    : LinearProblem(ball_space, is_incompressible, RestElasticity(stored, is_incompressible).moduli.shear,
                    std::max(RestElasticity(stored, is_incompressible).moduli.shear,
                             continuum::weight_of_density(gravity_constant))),
      elasticity(stored, is_incompressible),
      weight_of_density(continuum::weight_of_density(gravity_constant)) {
  const Vector& X = space.reference_positions();
  if (incompressible) set_constraint(kernels, X);
  const CellStiffness cells(space);
  set_stiffness([&](unsigned int cell) {
    return cells.cell_matrix(cell, X, [&](int, const auto&) { return elasticity.tangent; });
  });
  if (weight_of_density == 0) return;
  const auto springs = springs_at_surface(space, [&](const FacePoint& point) -> Eigen::Vector3d {
    const FacePoint::Jet at = point.jet(X);
    return std::sqrt(weight_of_density * at.by_p.cross(at.by_q).norm()) * at.u.normalized();
  });
  add_springs(springs);
  const auto degree = static_cast<std::size_t>(space.degree());
  factorises_gravity_ = 3 * springs.size() * degree * degree <= most_coupled;
  if (factorises_gravity_) couple_surface();
}

BeyondCells RestProblem::beyond_cells(const ParitySector& sector) const {
  if (weight_of_density == 0) return {};
  const SurfaceHarmonics harmonics(space, sector.parity(), largest_resolved_degree(space));
  std::vector<Eigen::VectorXd> rows;
  for (int n = 0; n <= harmonics.max_degree(); ++n)
    for (const std::size_t field : harmonics.radial_fields(n)) {
      const double share = n == 0 ? 1 : 3 / (2.0 * n + 1);
      // If I is the integral of (u·e) Y_nm over the octant, the integral over the sphere is 8 I. The energy of the
      // octant is an eighth of the energy of the sphere. Its quadratic term is therefore (8 I)²/8 = 8 I².
      rows.push_back(std::sqrt(8 * share * weight_of_density) * sector.entries_of(harmonics.force(field)));
    }
  Eigen::MatrixXd attraction(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(sector.n_unknowns()));
  for (std::size_t i = 0; i < rows.size(); ++i) attraction.row(static_cast<Eigen::Index>(i)) = rows[i];
  if (factorises_gravity_) {
    BeyondCells beyond{{}, unknowns_at_surface(sector), {}};
    const Eigen::MatrixXd of_surface = attraction(Eigen::all, beyond.unknowns);
    beyond.matrix = -of_surface.transpose() * of_surface;
    return beyond;
  }
  return {[attraction = std::move(attraction)](const Eigen::VectorXd& u) -> Eigen::VectorXd {
    return -(attraction.transpose() * (attraction * u));
  }};
}

}  // namespace pseudorigid::continuum
