#include "continuum/body/surface_gravity_forces.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>

#include "continuum/parallel/gather.h"
#include "continuum/parallel/ghost_values.h"
#include "continuum/parallel/ranks.h"

namespace pseudorigid::continuum {

int n_gravity_points(const BallSpace& space, bool is_fluid) {
  const bool refined = space.mesh().triangulation().n_global_levels() > 1;
  return static_cast<int>(space.degree()) + (refined && !is_fluid ? 1 : 2);
}

SurfaceGravityForces::SurfaceGravityForces(double gravity_constant, const BallSpace& space, int n_points)
    : constant_(gravity_constant), space_(space) {
  for (const CellFace& face : free_surface(space))
    for (FacePoint& point : quadrature_on(space, face, n_points)) {
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

gravity::SurfacePoints SurfaceGravityForces::own_rates(const Vector& x, const Vector& u) const {
  const GhostValues of_x(x), of_u(u);
  gravity::SurfacePoints rates;
  for (const Point& point : points_) {
    const FacePoint::Jet at = point.face_point.jet(x), rate = point.face_point.jet(u);
    rates.add(rate.u, point.weight * (rate.by_p.cross(at.by_q) + at.by_p.cross(rate.by_q)));
  }
  return rates;
}

gravity::SurfacePoints SurfaceGravityForces::sources(const gravity::SurfacePoints& own,
                                                     const std::array<int, 3>& s) const {
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
      for (double& component : image) component *= s[c];
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

void SurfaceGravityForces::spread(const Vector& x, const gravity::SurfaceDerivative& derivative, Vector& f) const {
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
}

void SurfaceGravityForces::add(const Vector& x, Vector& f) const {
  const gravity::SurfacePoints own = own_points(x);
  const gravity::PairSums sums = sum_pairs(own, sources(own));
  spread(x, surface_derivative(own, sums, over_ranks(totals(own, sums)), constant_, rest_volume_), f);
  add_to_owners(f);
}

void SurfaceGravityForces::add_rate(const Vector& x, const Vector& u, const std::array<int, 3>& s, Vector& f) const {
  const gravity::Moving own{own_points(x), own_rates(x, u)};
  const auto sums = sum_pairs(own, gravity::Moving{sources(own.at), sources(own.rate, s)});
  const auto [at, rate] = totals(own, sums);
  gravity::Moving of_all{over_ranks(at), over_ranks(rate)};
  for (int c = 0; c < 3; ++c)  // what is odd cancels with its images
    if (space_.mesh().sector().reflect[c] && s[c] < 0) of_all.rate = {};
  spread(x, surface_derivative_rate(own, sums, of_all, constant_, rest_volume_), f);
  gravity::SurfaceDerivative of_areas = surface_derivative(own.at, sums.at, of_all.at, constant_, rest_volume_);
  for (auto& component : of_areas.by_point) std::ranges::fill(component, 0.0);
  spread(u, of_areas, f);  // the areas depend on products of derivatives
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
