#include "continuum/output/nodal_fields.h"

#include <Eigen/Dense>
#include <array>
#include <span>

#include "continuum/kernels/node_gradients.h"
#include "continuum/output/branches_at_nodes.h"
#include "continuum/parallel/ghost_values.h"
#include "materials/point_fields.h"

namespace pseudorigid::continuum {
namespace {

using BallState = mechanics::VectorState<Vector>;

/// The factors ±1 of the three coordinates in each mirror image of the sector. The first image is the sector itself.
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

/// Appends the values at the mirror images to `values`, which has n_components values for each point of the sector.
/// n_components is 1 for scalars, 3 for vectors, and 9 for matrices. Components of vectors and matrices change sign
/// with the coordinates.
void reflect(std::vector<double>& values, int n_components, const Sector& sector) {
  const std::vector<double> of_sector = std::move(values);
  values.clear();
  values.reserve(of_sector.size() * sector.n_images());
  for (const auto& signs : images(sector))
    for (std::size_t i = 0; i < of_sector.size(); ++i) {
      const double sign = n_components == 3 ? signs[i % 3] : n_components == 9 ? signs[i / 3 % 3] * signs[i % 3] : 1;
      values.push_back(sign * of_sector[i]);
    }
}

/// The potential φ of self-gravity at the nodes of all cells of this rank, cell by cell. The result is empty without
/// self-gravity. Collective.
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

/// Returns the constant ρφ̄ = (5/3)Ê/V, with the energy Ê of self-gravity and the volume V. The multiplier is larger
/// than the Kirchhoff pressure by ρ(φ − φ̄), with the potential φ. Collective.
double mean_potential(const BallBody& ball, const Vector& position) {
  const int n_images = ball.space().mesh().sector().n_images();
  return 5.0 / 3 * n_images * ball.gravity()->energy(position) / ball.volume();
}

/// Appends the fields at the nodes of a cell to `fields`, except the potential, which must already be set. A null
/// `multiplier` means a multiplier of 0. `mean_potential` is ρφ̄, or 0 without self-gravity. Fails if det F is not
/// positive and finite at a node.
mechanics::Status add_cell(const BallBody& ball, const BallState& state, const Vector* multiplier,
                           double mean_potential, unsigned int cell, mechanics::BodyFields& fields) {
  const BallSpace& space = ball.space();
  const int n_nodes = static_cast<int>(space.nodes_per_cell());
  const Eigen::Matrix3Xd X = nodal_values(space, space.reference_positions(), cell),
                         x = nodal_values(space, state.q, cell), v = nodal_values(space, state.v, cell);
  std::vector<double> lambda(n_nodes, 0.0);
  if (multiplier) ball.kernels().multiplier_at_nodes(*multiplier, cell, lambda);
  if (ball.gravity())
    for (int i = 0; i < n_nodes; ++i)
      lambda[i] -= fields.potential[static_cast<std::size_t>(cell) * n_nodes + i] - mean_potential;
  const auto branches = branches_at_nodes(ball, state.q, cell);
  for (int i = 0; i < n_nodes; ++i) {
    const Eigen::Matrix3d F =
        reference_gradient(space.reference_cell(), x, i) * reference_gradient(space.reference_cell(), X, i).inverse();
    if (auto status = materials::add_point(ball.law(), X.col(i), x.col(i), v.col(i), F, lambda[i], branches[i], fields);
        !status)
      return status;
  }
  return {};
}

/// Sets `fields` at the points of `nodal_blocks`. `multiplier` is null for a ball without constraint. Fails if det F is
/// not positive and finite at a node of this rank. Collective.
mechanics::Status all_fields(const BallBody& ball, const BallState& state, const Vector* multiplier,
                             mechanics::BodyFields& fields) {
  fields = {};
  fields.potential = potential_at_nodes(ball, state.q);
  const double mean = ball.gravity() ? mean_potential(ball, state.q) : 0;
  fields.center = ball.mean(state.q);
  Vector relative = state.q;
  relative.add(-1.0, ball.affine_field(Eigen::Matrix3d::Zero(), fields.center));
  fields.moment = ball.mass_moment(relative) * ball.E0();
  const GhostValues ghosts(state.q), ghosts_of_velocity(state.v);
  for (unsigned int cell = 0; cell < ball.space().n_cells(); ++cell)
    if (auto status = add_cell(ball, state, multiplier, mean, cell, fields); !status) return status;
  const Sector& sector = ball.space().mesh().sector();
  for (auto* vectors : {&fields.X, &fields.x, &fields.v}) reflect(*vectors, 3, sector);
  for (auto* matrices : {&fields.F, &fields.stress}) reflect(*matrices, 9, sector);
  for (auto* scalars : {&fields.energy, &fields.potential}) reflect(*scalars, 1, sector);
  return {};
}

/// Appends the numbers of the n³ points of a cell, which are consecutive from `first_point`. `mirrored` is true for an
/// image after an odd number of reflections. The order of its layers is then reversed, so that the cell is
/// right-handed.
void add_block(int n, std::int64_t first_point, bool mirrored, std::vector<std::int64_t>& points) {
  for (int k = 0; k < n; ++k)
    for (int ij = 0; ij < n * n; ++ij) points.push_back(first_point + (mirrored ? n - 1 - k : k) * n * n + ij);
}

/// Interpolates values at the nodes of a cell to equidistant points along one direction. Three calls, one for each
/// direction, interpolate the cell. The indices of neighbours in the direction differ by `stride`.
void interpolate_along(const std::vector<double>& to_equidistant, int n, std::size_t stride, int n_components,
                       std::span<double> cell) {
  std::vector<double> line(n);
  const std::size_t n_points = cell.size() / n_components;
  for (std::size_t point = 0; point < n_points; ++point) {
    if (point / stride % n != 0) continue;  // a line starts at a point with the index 0 in this direction
    for (int c = 0; c < n_components; ++c) {
      const auto value = [&](int i) -> double& { return cell[n_components * (point + i * stride) + c]; };
      for (int q = 0; q < n; ++q) {
        line[q] = 0;
        for (int i = 0; i < n; ++i) line[q] += to_equidistant[q * n + i] * value(i);
      }
      for (int q = 0; q < n; ++q) value(q) = line[q];
    }
  }
}

void make_equidistant(const BallSpace& space, int n_components, std::vector<double>& values) {
  const ReferenceCell& ref = space.reference_cell();
  std::vector<double> to_equidistant;
  for (int q = 0; q < ref.n; ++q)
    for (int i = 0; i < ref.n; ++i)
      to_equidistant.push_back(lagrange(ref.nodes, i, static_cast<double>(q) / (ref.n - 1)));
  const std::size_t size = static_cast<std::size_t>(n_components) * space.nodes_per_cell();
  for (std::size_t begin = 0; begin < values.size(); begin += size)
    for (std::size_t d = 0, stride = 1; d < 3; ++d, stride *= ref.n)
      interpolate_along(to_equidistant, ref.n, stride, n_components, std::span(values).subspan(begin, size));
}

}  // namespace

mechanics::PointBlocks nodal_blocks(const BallSpace& space) {
  mechanics::PointBlocks blocks{.degree = space.degree(), .points = {}};
  std::int64_t first_point = 0;
  for (const auto& signs : images(space.mesh().sector()))
    for (unsigned int cell = 0; cell < space.n_cells(); ++cell, first_point += space.nodes_per_cell())
      add_block(space.reference_cell().n, first_point, signs[0] * signs[1] * signs[2] < 0, blocks.points);
  return blocks;
}

std::vector<double> nodal_positions(const BallSpace& space) {
  std::vector<double> positions;
  for (unsigned int cell = 0; cell < space.n_cells(); ++cell) {
    const Eigen::Matrix3Xd X = nodal_values(space, space.reference_positions(), cell);
    positions.insert(positions.end(), X.data(), X.data() + X.size());
  }
  reflect(positions, 3, space.mesh().sector());
  return positions;
}

mechanics::Status nodal_fields(const ElasticBall& ball, const mechanics::State<ElasticBall>& state,
                               ElasticBall::Workspace& workspace, mechanics::BodyFields& fields) {
  Vector multiplier = ball.make_multiplier();
  if (auto status = mechanics::multiplier_of_motion(ball, state, workspace, multiplier); !status) return status;
  return all_fields(ball, state, &multiplier, fields);
}

mechanics::Status nodal_fields(const CompressibleBall& ball, const mechanics::State<CompressibleBall>& state,
                               CompressibleBall::Workspace&, mechanics::BodyFields& fields) {
  return all_fields(ball, state, nullptr, fields);
}

void make_equidistant(const BallSpace& space, std::vector<double>& vectors) { make_equidistant(space, 3, vectors); }

void make_equidistant(const BallSpace& space, mechanics::BodyFields& fields) {
  for (auto* vectors : {&fields.X, &fields.x, &fields.v}) make_equidistant(space, 3, *vectors);
  for (auto* matrices : {&fields.F, &fields.stress}) make_equidistant(space, 9, *matrices);
  for (auto* scalars : {&fields.energy, &fields.potential}) make_equidistant(space, 1, *scalars);
}

}  // namespace pseudorigid::continuum
