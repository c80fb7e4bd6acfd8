#include "continuum/body/surface_gravity_forces.h"

#include <Eigen/Dense>
#include <array>

#include "continuum/parallel/gather.h"
#include "continuum/parallel/ghost_values.h"
#include "continuum/parallel/ranks.h"

namespace pseudorigid::continuum {

SurfaceGravityForces::SurfaceGravityForces(double gravity_constant, const BallSpace& space)
    : constant_(gravity_constant), space_(space) {
  for (const CellFace& face : free_surface(space))
    for (FacePoint& point : quadrature_on(space, face)) {
      const double weight = face.end == 1 ? point.weight : -point.weight;
      points_.push_back({std::move(point), weight});
    }
  rest_volume_ = sum_over_ranks(enclosed_volume(own_points(space.reference_positions())), space.communicator());
}

gravity::SurfacePoints SurfaceGravityForces::own_points(const Vector& x) const {
  const GhostValues of_x(x);
  gravity::SurfacePoints points;
  for (const Point& point : points_) {
    const FacePoint::Jet jet = point.face_point.jet(x);
    points.add(jet.u, point.weight * jet.by_p.cross(jet.by_q));
  }
  return points;
}

gravity::SurfacePoints SurfaceGravityForces::sources(const gravity::SurfacePoints& own) const {
  using Entry = std::array<double, 6>;
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < own.size(); ++i)
    entries.push_back({own.x[0][i], own.x[1][i], own.x[2][i], own.N[0][i], own.N[1][i], own.N[2][i]});
  entries = gather_on_all(space_.communicator(), entries);
  for (int c = 0; c < 3; ++c) {
    if (!space_.mesh().sector().reflect[c]) continue;
    const std::size_t n = entries.size();
    for (std::size_t i = 0; i < n; ++i) {
      Entry image = entries[i];
      image[c] = -image[c];
      image[3 + c] = -image[3 + c];
      entries.push_back(image);
    }
  }
  gravity::SurfacePoints all;
  for (const auto& [x0, x1, x2, N0, N1, N2] : entries) all.add({x0, x1, x2}, {N0, N1, N2});
  return all;
}

gravity::SurfaceTotals SurfaceGravityForces::over_ranks(const gravity::SurfaceTotals& own) const {
  const auto [pairs, volume] = sum_over_ranks(std::array{own.pairs, own.volume}, space_.communicator());
  return {pairs, volume};
}

void SurfaceGravityForces::add(const Vector& x, Vector& f) const {
  const gravity::SurfacePoints own = own_points(x);
  const gravity::PairSums sums = sum_pairs(own, sources(own));
  const auto derivative = surface_derivative(own, sums, over_ranks(totals(own, sums)), constant_, rest_volume_);
  const GhostValues of_x(x);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const auto& [point, weight] = points_[i];
    const FacePoint::Jet jet = point.jet(x);
    const auto at_point = [i](const auto& field) { return Eigen::Vector3d(field[0][i], field[1][i], field[2][i]); };
    const Eigen::Vector3d by_point = at_point(derivative.by_point), by_area = weight * at_point(derivative.by_area);
    const Eigen::Vector3d along_p = jet.by_q.cross(by_area), along_q = by_area.cross(jet.by_p);
    for (const FacePoint::Node& n : point.nodes)
      for (int c = 0; c < 3; ++c)
        f.local_element(3 * n.node + c) -= n.value * by_point[c] + n.by_p * along_p[c] + n.by_q * along_q[c];
  }
  add_to_owners(f);
}

double SurfaceGravityForces::energy(const Vector& x) const {
  const gravity::SurfacePoints own = own_points(x);
  return surface_energy(over_ranks(totals(own, sum_pairs(own, sources(own)))), constant_, rest_volume_);
}

std::vector<double> SurfaceGravityForces::potential(const Vector& x, const std::vector<Eigen::Vector3d>& points) const {
  return potential_at(points, sources(own_points(x)), constant_);
}

}  // namespace pseudorigid::continuum
