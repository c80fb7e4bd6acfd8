#include "continuum/output/nodal_fields.h"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <cstdio>
#include <variant>

#include "continuum/kernels/node_gradients.h"
#include "continuum/parallel/ghost_values.h"
#include "materials/eigen_tensor.h"

namespace pseudorigid::continuum {
namespace {

/// Signs of the coordinates in each reflection of the sector, the sector itself first.
std::vector<std::array<double, 3>> images(const Sector& sector) {
  std::vector<std::array<double, 3>> result;
  for (int bits = 0; bits < 8; ++bits) {
    std::array<double, 3> signs{1, 1, 1};
    bool wanted = true;
    for (int d = 0; d < 3; ++d)
      if (bits >> d & 1) {
        signs[d] = -1;
        wanted = wanted && sector.reflect[d];
      }
    if (wanted) result.push_back(signs);
  }
  return result;
}

/// Repeats values of the sector, n_components per point, for all its images; vectors change sign with the coordinates.
void reflect(std::vector<double>& values, int n_components, const Sector& sector) {
  const std::vector<double> of_sector = std::move(values);
  values.clear();
  for (const auto& signs : images(sector))
    for (std::size_t i = 0; i < of_sector.size(); ++i)
      values.push_back(n_components == 3 ? signs[i % 3] * of_sector[i] : of_sector[i]);
}

mechanics::Status inverted(double J, const Eigen::Vector3d& X) {
  char text[160];
  std::snprintf(text, sizeof text, "no stress to draw: det F = %.3g at the node X/r = (%.3f, %.3f, %.3f)", J, X[0],
                X[1], X[2]);
  return mechanics::Status::failure(text);
}

/// Appends pressure, det F and von Mises stress at a node.
void add_stress(const materials::AnyLaw& law, const Eigen::Matrix3d& F, double lambda, NodalFields& fields) {
  const double J = F.determinant();
  const Eigen::Matrix3d P =
      std::visit([&](const auto& l) { return materials::to_matrix(l.stress(materials::to_tensor(F))); }, law);
  const Eigen::Matrix3d sigma = (P * F.transpose() - lambda * Eigen::Matrix3d::Identity()) / J;
  const double mean = sigma.trace() / 3;
  fields.pressure.push_back(-mean);
  fields.jacobian.push_back(J);
  fields.von_mises.push_back(std::sqrt(1.5) * (sigma - mean * Eigen::Matrix3d::Identity()).norm());
}

/// φ at the nodes of all cells; empty without self-gravity. Collective.
std::vector<double> potential_at_nodes(const BallBody& ball, const Vector& position) {
  if (!ball.gravity()) return {};
  std::vector<Eigen::Vector3d> points;
  {
    const GhostValues ghosts(position);
    for (unsigned int cell = 0; cell < ball.space().n_cells(); ++cell) {
      const Eigen::Matrix3Xd x = nodal_values(ball.space(), position, cell);
      for (Eigen::Index i = 0; i < x.cols(); ++i) points.emplace_back(x.col(i));
    }
  }
  return ball.gravity()->potential(position, points);
}

/// ρφ̄, ρφ̄V = (5/3)Ê: the multiplier is above the pressure by ρ(φ − φ̄). Collective.
double mean_potential(const BallBody& ball, const Vector& position) {
  const int n_images = ball.space().mesh().sector().n_images();
  return 5.0 / 3 * n_images * ball.gravity()->energy(position) / ball.volume();
}

/// Appends the fields at the nodes of a cell; no multiplier counts as 0.
mechanics::Status add_cell(const BallBody& ball, const materials::AnyLaw& law, const Vector& position,
                           const Vector* multiplier, double mean_potential, unsigned int cell, NodalFields& fields) {
  const BallSpace& space = ball.space();
  const int n_nodes = static_cast<int>(space.nodes_per_cell());
  const Eigen::Matrix3Xd X = nodal_values(space, space.reference_positions(), cell),
                         x = nodal_values(space, position, cell);
  std::vector<double> lambda(n_nodes, 0.0);
  if (multiplier) ball.kernels().multiplier_at_nodes(*multiplier, cell, lambda);
  if (ball.gravity())
    for (int i = 0; i < n_nodes; ++i)
      lambda[i] -= fields.potential[static_cast<std::size_t>(cell) * n_nodes + i] - mean_potential;
  for (int i = 0; i < n_nodes; ++i) {
    const Eigen::Matrix3d F =
        reference_gradient(space.reference_cell(), x, i) * reference_gradient(space.reference_cell(), X, i).inverse();
    if (const double J = F.determinant(); !(J > 0 && std::isfinite(J))) return inverted(J, X.col(i));
    for (int c = 0; c < 3; ++c) fields.displacement.push_back(x(c, i) - X(c, i));
    add_stress(law, F, lambda[i], fields);
  }
  return {};
}

/// All fields at all points, from positions and a multiplier, if there is one.
mechanics::Status all_fields(const BallBody& ball, const materials::AnyLaw& law, const Vector& position,
                             const Vector* multiplier, NodalFields& fields) {
  fields = {};
  fields.potential = potential_at_nodes(ball, position);
  const double mean = ball.gravity() ? mean_potential(ball, position) : 0;
  const GhostValues ghosts(position);
  for (unsigned int cell = 0; cell < ball.space().n_cells(); ++cell)
    if (auto status = add_cell(ball, law, position, multiplier, mean, cell, fields); !status) return status;
  const Sector& sector = ball.space().mesh().sector();
  reflect(fields.displacement, 3, sector);
  for (auto* scalar : {&fields.pressure, &fields.jacobian, &fields.von_mises, &fields.potential})
    reflect(*scalar, 1, sector);
  return {};
}

/// The k³ hexahedra between the nodes of a cell, in VTK's order: the lower face against the clock, then the upper one.
/// A mirror image takes the upper face first.
void add_hexahedra(int n, std::int64_t first_node, bool mirrored, std::vector<std::int64_t>& connectivity) {
  const std::array<int, 4> face{0, 1, n + 1, n};
  const std::array<int, 2> levels = mirrored ? std::array{n * n, 0} : std::array{0, n * n};
  for (int k = 0; k + 1 < n; ++k)
    for (int j = 0; j + 1 < n; ++j)
      for (int i = 0; i + 1 < n; ++i)
        for (const int level : levels)
          for (const int corner : face) connectivity.push_back(first_node + (k * n + j) * n + i + level + corner);
}

}  // namespace

NodalGrid nodal_grid(const BallSpace& space) {
  NodalGrid grid;
  for (unsigned int cell = 0; cell < space.n_cells(); ++cell) {
    const Eigen::Matrix3Xd X = nodal_values(space, space.reference_positions(), cell);
    grid.points.insert(grid.points.end(), X.data(), X.data() + X.size());
  }
  const Sector& sector = space.mesh().sector();
  reflect(grid.points, 3, sector);

  std::int64_t first_node = 0;
  for (const auto& signs : images(sector))
    for (unsigned int cell = 0; cell < space.n_cells(); ++cell, first_node += space.nodes_per_cell())
      add_hexahedra(space.reference_cell().n, first_node, signs[0] * signs[1] * signs[2] < 0, grid.connectivity);
  return grid;
}

mechanics::Status nodal_fields(const ElasticBall& ball, const materials::AnyLaw& law,
                               const mechanics::State<ElasticBall>& state, ElasticBall::Workspace& workspace,
                               NodalFields& fields) {
  Vector multiplier = ball.make_multiplier();
  if (auto status = mechanics::multiplier_of_motion(ball, state, workspace, multiplier); !status) return status;
  return all_fields(ball, law, state.q, &multiplier, fields);
}

mechanics::Status nodal_fields(const CompressibleBall& ball, const materials::AnyLaw& law,
                               const mechanics::State<CompressibleBall>& state, CompressibleBall::Workspace&,
                               NodalFields& fields) {
  return all_fields(ball, law, state.q, nullptr, fields);
}

}  // namespace pseudorigid::continuum
